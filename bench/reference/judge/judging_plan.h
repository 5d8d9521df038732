// Selects the frames of a run that get metrics: individual moments, and a stretch of consecutive frames for popping.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/export/volume_settings.h"

namespace dustbench::reference {

inline constexpr std::int64_t minimumMoments = 5;

struct MetricPlan {
    /// Empty: five moments, evenly spaced from the first frame to the last.
    std::optional<exports::FrameRange> moments;
    /// Empty: the reference is the ground truth of the particles. Otherwise it is the same method with these parameters
    /// set to finer values, for methods with their own simulation, which have no ground truth.
    std::map<std::string, std::string, std::less<>> finer;

    bool keepsPictures = true;  ///< writes the judged pictures, their references and differences

    /// `exact`, or `depth=10 levels=5`.
    [[nodiscard]] std::string referenceText() const;
    /// The moments of a run with this many frames, ascending.
    [[nodiscard]] std::vector<std::int64_t> momentsOf(std::int64_t frames) const;
    /// The last frames, enough for PoppingSummary::minimumPairs; empty if the run has fewer.
    [[nodiscard]] static std::vector<std::int64_t> stretchOf(std::int64_t frames);
};

/// Throws InputError for fewer than five moments, or moments beyond the end of the run.
void requireMomentsWithinRun(const MetricPlan& plan, std::int64_t frames);

}  // namespace dustbench::reference
