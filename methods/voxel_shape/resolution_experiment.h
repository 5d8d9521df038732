// How many voxels a side a shape needs to keep its outline.
//
// A shape at rest is seen from three sides at each resolution, with as many particles a voxel at each, and its picture
// held against the outline of its mesh. The knee of that curve is the resolution at which it lies highest above the
// straight line from its first point to its last: from there on a voxel more gains less than on the average.
// Findings, of each preset over three seeds and of all: `silhouette_knee` in voxels a side (its interval holds half a
// step of the sweep besides), `silhouette_at_50` and `_at_120`, and of all `silhouette_kept_at_50`, the former by the
// latter.
// Controls: `silhouette_kept_at_10` and `_at_110`, and `knee_of_late_curve`, of a curve whose knee is at 100.
//
// Source: JuckelBeckhaus2007, 6 and 7. The knee: Satopaa2011.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "methods/contract/experiment.h"

namespace dustbench::voxel_shape::resolution {

struct Curve {
    std::vector<int> voxelsASide;  ///< rising
    std::vector<double> overlaps;  ///< intersection over union, mean over the sides
    /// Empty curves and flat ones have their knee at their first point.
    [[nodiscard]] double knee() const;
};

/// Of a preset, from 10 to 120 voxels a side.
[[nodiscard]] Curve outlineOf(ExperimentContext& context, const std::string& shape, std::uint64_t seed);

[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::voxel_shape::resolution
