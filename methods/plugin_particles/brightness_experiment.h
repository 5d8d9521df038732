// Measures how drawing methods affect brightness: lines of fast particles, order of additive light, white backgrounds
// (claims R17 and R21).
//
// Units: m. Threads: that of the device. Source: Thesis, 4.1.1 (blending) and 4.1.3 (lines).
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::plugin_particles::brightness {

/// The experiment `brightness`:
///     point_light_4x, line_light_4x, hybrid_light_4x
///                              light of a particle, summed over the picture, at four times the speed relative to the
///                              original speed: mean over 100 random directions across the view
///     shuffled_additive, shuffled_clamped, shuffled_alpha
///                              largest difference of any pixel between two orders of the same 400 points: additive
///                              light, the same clamped in its own buffer, and alpha without sorting
///     contrast_white_additive, contrast_white_alpha
///                              largest difference that the points make to a white background on a display that clips
///                              at 1
[[nodiscard]] ExperimentInfo describe();
[[nodiscard]] std::vector<Finding> measureBrightness(gpu::Device& device, std::uint64_t seed);

}  // namespace dustbench::plugin_particles::brightness
