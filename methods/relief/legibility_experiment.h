// Measures how many particles make a sign illegible.
//
// Particles of 2 g hit the scene's sign at random places, straight and at 5 m/s. The sign counts as illegible once the
// structural similarity (SSIM, Wang2004) of its face, drawn from the front, to the fresh one falls below 0.5.
// Particles come in lots, each a twentieth of the particles before; between lots, the logarithm of their number is
// interpolated.
//
// Findings, means over 5 seeds: `particles_paper` (each hit sinks one texel and turns it white), `particles_crater` at
// 10⁴ J/m³, `particles_crater_soft` at half of that, and `hardness_ratio`, the quotient of the latter two: 2 if only
// the removed volume matters. Controls: `hardness_ratio_of_equals` for two signs of the same hardness, and
// `hardness_ratio_of_volume` with the removal of a twentieth of the sign's volume instead of illegibility.
//
// Threads: the OpenGL thread. Source: Wang2004; the question is ours.
#pragma once

#include "methods/contract/experiment.h"
#include "methods/kit/pictures/image.h"
#include "methods/relief/ageing.h"

namespace dustbench::relief::legibility {

/// Mean SSIM of the luma of two opaque pictures of the same size, as displayed: 11 × 11 Gaussian windows entirely
/// inside, σ = 1.5. reports/METRICS.md defines it.
[[nodiscard]] double similarity(const pictures::Image& reference, const pictures::Image& picture);

/// The number of particles at which the similarity falls below `threshold`.
[[nodiscard]] double particlesUntil(double threshold, gpu::Device& device, const scene::Scene& scene,
                                    const scene::Panel& panel, const AgeingSettings& ageing, std::uint64_t seed);

/// The number of particles that remove this share of the sign's volume.
[[nodiscard]] double particlesUntilTaken(double share, const scene::Panel& panel, const AgeingSettings& ageing,
                                         std::uint64_t seed);

[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::relief::legibility
