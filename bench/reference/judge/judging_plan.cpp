#include "bench/reference/judge/judging_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/measure/image/popping.h"
#include "methods/contract/errors.h"

namespace dustbench::reference {

std::vector<std::int64_t> MetricPlan::momentsOf(std::int64_t frames) const {
    std::vector<std::int64_t> list;
    if (moments) {
        for (std::int64_t frame = moments->first; frame <= moments->last; frame += moments->step) list.push_back(frame);
        return list;
    }
    const std::int64_t count = std::min(frames, minimumMoments);
    for (std::int64_t k = 0; k < count; ++k) list.push_back(count == 1 ? 0 : k * (frames - 1) / (count - 1));
    return list;
}

std::vector<std::int64_t> MetricPlan::stretchOf(std::int64_t frames) {
    std::vector<std::int64_t> list;
    const std::int64_t count = measure::PoppingSummary::minimumPairs + 1;
    if (frames < count) return list;
    for (std::int64_t frame = frames - count; frame < frames; ++frame) list.push_back(frame);
    return list;
}

std::string MetricPlan::referenceText() const {
    if (finer.empty()) return "exact";
    std::string text;
    for (const auto& [name, value] : finer) text += (text.empty() ? "" : " ") + name + "=" + value;
    return text;
}

void requireMomentsWithinRun(const MetricPlan& plan, std::int64_t frames) {
    if (!plan.moments) return;
    if (plan.moments->count() < minimumMoments)
        throw InputError(fmt::format("metric frames: got {} frames ({}), allowed: {} or more", plan.moments->count(),
                                     plan.moments->text(), minimumMoments));
    if (plan.moments->last >= frames)
        throw InputError(fmt::format("metric frames: frame {} is beyond the run's end, allowed: frames 0..{}",
                                     plan.moments->last, frames - 1));
}

}  // namespace dustbench::reference
