// Which frames of a run are judged: some moments one by one, and a stretch of consecutive frames for popping.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/export/frame_range.h"

namespace dustbench::bench {

inline constexpr std::int64_t minimumMoments = 5;

struct JudgingPlan {
    /// None: five moments, evenly from the first frame to the last.
    std::optional<FrameRange> moments;
    /// None: the exact picture of the particles. Else the reference is the same method with these of its parameters
    /// set to something finer: for methods with a simulation of their own, whose exact picture nobody has.
    std::map<std::string, std::string, std::less<>> finer;

    /// `exact`, or `depth=10 levels=5`.
    [[nodiscard]] std::string referenceText() const;
    /// Of a run of so many frames, rising.
    [[nodiscard]] std::vector<std::int64_t> momentsOf(std::int64_t frames) const;
    /// The last frames, enough for PoppingSummary::minimumPairs; empty where the run has fewer.
    [[nodiscard]] static std::vector<std::int64_t> stretchOf(std::int64_t frames);
};

/// Throws InputError for fewer than five moments, or moments beyond the end of a run of so many frames.
void requireMomentsWithinRun(const JudgingPlan& plan, std::int64_t frames);

}  // namespace dustbench::bench
