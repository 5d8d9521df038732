#include "bench/measure/stage_recorder.h"

#include <algorithm>

namespace dustbench::bench {

void StageRecorder::clear() {
    stageNs_.fill(0);
    details_.clear();
    openStages_.clear();
    openDetails_.clear();
}

std::int64_t StageRecorder::transition(bool somethingWasQueued) {
    if (fence_ && somethingWasQueued) fence_();
    const std::int64_t now = now_();
    if (!openStages_.empty()) stageNs_[static_cast<std::size_t>(openStages_.back())] += now - stageSince_;
    stageSince_ = now;
    return now;
}

void StageRecorder::creditDetail(std::int64_t now) {
    if (!openDetails_.empty()) details_[openDetails_.back()].ns += now - detailSince_;
    detailSince_ = now;
}

void StageRecorder::begin(Stage stage) {
    transition(!openStages_.empty());
    openStages_.push_back(stage);
}

void StageRecorder::end(Stage) {
    transition(true);
    if (!openStages_.empty()) openStages_.pop_back();
}

void StageRecorder::beginDetail(std::string_view name) {
    creditDetail(transition(!openStages_.empty()));
    const Stage stage = openStages_.empty() ? Stage::build : openStages_.back();
    const auto known = std::ranges::find_if(
        details_, [&](const Detail& detail) { return detail.name == name && detail.stage == stage; });
    openDetails_.push_back(static_cast<std::size_t>(known - details_.begin()));
    if (known == details_.end()) details_.push_back({stage, name});
}

void StageRecorder::endDetail(std::string_view) {
    creditDetail(transition(true));
    if (!openDetails_.empty()) openDetails_.pop_back();
}

}  // namespace dustbench::bench
