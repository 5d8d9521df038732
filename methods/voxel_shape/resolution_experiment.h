// Finds how many voxels per side a shape needs to keep its outline.
//
// A shape at rest is viewed from three sides at each resolution, always with the same number of particles per voxel.
// Its picture is compared with the outline of its mesh. The knee of the curve is the resolution at which the curve is
// highest above the chord from its first to its last point; beyond it, an additional voxel gains less than the average.
// Findings, for each preset over five seeds: `silhouette_knee`, in voxels per side (its interval includes half a step
// of the sweep), `silhouette_at_50`, `silhouette_at_120` and their ratio, `silhouette_kept_at_50`. Controls:
// `silhouette_kept_at_10` and `_at_110`, and `knee_of_late_curve` for a curve whose knee is at 100.
//
// Source: JuckelBeckhaus2007, 6 and 7. The knee: Satopaa2011.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "methods/contract/experiment.h"

namespace dustbench::voxel_shape::resolution {

struct Curve {
    std::vector<int> voxelsASide;  ///< increasing
    std::vector<double> overlaps;  ///< intersection over union, mean over the sides
    /// Returns the knee in voxels per side: the first point of a flat curve, 0 for an empty one.
    [[nodiscard]] double knee() const;
};

/// Returns the curve of a preset from 10 to 120 voxels per side.
[[nodiscard]] Curve outlineOf(ExperimentContext& context, const std::string& shape, std::uint64_t seed);

[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::voxel_shape::resolution
