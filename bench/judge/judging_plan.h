// Which frames of a run are judged: some moments one by one, and a stretch of consecutive frames for popping.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/export/frame_range.h"

namespace dustbench::bench {

inline constexpr std::int64_t fewestMoments = 5;

struct JudgingPlan {
    /// None: five moments, evenly from the first frame to the last.
    std::optional<FrameRange> moments;

    /// Of a run of so many frames, rising.
    [[nodiscard]] std::vector<std::int64_t> momentsOf(std::int64_t frames) const;
    /// The last frames, enough for PoppingSummary::fewestPairs; empty where the run has fewer.
    [[nodiscard]] static std::vector<std::int64_t> stretchOf(std::int64_t frames);
};

/// Throws InputError for fewer than five moments, or moments beyond the end of a run of so many frames.
void requireMomentsWithinRun(const JudgingPlan& plan, std::int64_t frames);

}  // namespace dustbench::bench
