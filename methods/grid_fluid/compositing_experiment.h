// Composites the samples of rays from the front and from the back: whether the picture is the same, and how many
// samples a ray may leave out that ends where nothing more is seen (claim R31).
//
//     front to back    C ← C + c·a·(1 − A),   A ← A + a·(1 − A)
//     back to front    C ← c·a + C·(1 − a),   A ← a + A·(1 − a)
//
// in floats, as a fragment shader has them. The clouds are lumps of smoke that burn, so that colour depends on order.
// The march of OpenGL is compared with its slices, which the hardware blends from the back at the same places.
// Threads: that of the device. Source: Senger2009, 3.3 and 4.2.2.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "methods/contract/experiment.h"

namespace dustbench::grid_fluid::compositing {

/// What a ray has met of a cloud at one place: its colour, and its opacity over a step.
struct Sample {
    glm::vec3 colour{0};
    float opacity = 0;
};

struct Composite {
    glm::vec4 seen{0};  ///< premultiplied
    int samples = 0;    ///< that were looked at
};

/// `samples` are from front to back in both. `stopAlpha`: no further sample is looked at beyond it; 1: all are.
[[nodiscard]] Composite frontToBack(std::span<const Sample> samples, float stopAlpha);
[[nodiscard]] Composite backToFront(std::span<const Sample> samples);

/// The experiment `compositing`, of clouds drawn by the seed. Maximum differences of a channel over all pixels:
///     orders_formulas    the two formulas
///     orders_gl          OpenGL's march and slices
///     orders_wrong       control: the formula from the back, given the samples from the front
///     stopped_DEPTH      rays that end beyond an alpha of 0.99, from those that do not
/// and the mean share of samples left out by rays through the middle of a cloud:
///     saved_DEPTH        DEPTH: optical depth through the middle, 2, 5, 10, 20, 40
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::compositing
