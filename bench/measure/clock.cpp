#include "bench/measure/clock.h"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include "bench/measure/statistics.h"

namespace dustbench::measure {
namespace {

/// Median over several rounds of the nanoseconds per call.
template <typename Call>
double costNs(const Call& call) {
    constexpr int callsPerRound = 1000;
    std::array<double, 21> rounds;
    for (double& round : rounds) {
        const std::int64_t begin = steadyNow();
        for (int i = 0; i < callsPerRound; ++i) call();
        round = static_cast<double>(steadyNow() - begin) / callsPerRound;
    }
    return median(rounds);
}

}  // namespace

std::int64_t steadyNow() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double secondsSinceProcessStart() {
    std::ifstream file("/proc/self/stat");
    // The second field is the program's name in brackets and may contain spaces; the 22nd is the start in ticks since
    // boot.
    file.ignore(std::numeric_limits<std::streamsize>::max(), ')');
    std::string skipped;
    for (int field = 3; field < 22; ++field) file >> skipped;
    std::int64_t startTicks = 0;
    timespec now{};
    if (!(file >> startTicks) || clock_gettime(CLOCK_BOOTTIME, &now) != 0)
        throw std::runtime_error("/proc/self/stat: does not contain the start time of this process");
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9 -
           static_cast<double>(startTicks) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

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

ClockCost measureClockCost() {
    StageRecorder recorder;
    const StageClock clock(&recorder);
    return {costNs([] { [[maybe_unused]] const volatile std::int64_t now = steadyNow(); }),
            costNs([&] { const auto timing = clock.measure(Stage::build); })};
}

}  // namespace dustbench::measure
