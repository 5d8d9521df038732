// Measures what culling and level of detail of particles save, and the error that they make (P18).
//
// Units: m, pixels. Threads: that of the device. Source: Thesis, 7 (future work): level of detail, culling.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::plugin_particles::detail {

/// The experiment `detail`: 60,000 puffs of 0.4 m, in a layer 6 m high on all sides of an eye at 320 × 240.
///     culled_share, culled_time, culled_difference
///                              with culling: particles drawn over all; time to select, sort, upload and draw, over
///                              that without; largest difference of any pixel
///     detail_P_share, detail_P_time, detail_P_rms, detail_P_depth
///                              with detail_pixels = P (1, 2, 4, 8), compared with culling alone: the same shares; the
///                              root mean square difference of the pictures (linear, over black); the mean alpha over
///                              the whole picture, relative to that without detail
///     time_of_equals           a control: without either, measured twice
[[nodiscard]] ExperimentInfo describe();
[[nodiscard]] std::vector<Finding> measureDetail(gpu::Device& device, std::uint64_t seed, std::size_t particles,
                                                 int repetitions);

}  // namespace dustbench::plugin_particles::detail
