// Composites the samples of rays front to back and back to front. Checks whether the pictures are the same, and how
// many samples a ray saves by ending where nothing more is visible (claim R31).
//
//     front to back    C ← C + c·a·(1 − A),   A ← A + a·(1 − A)
//     back to front    C ← c·a + C·(1 − a),   A ← a + A·(1 − a)
//
// in floats, as in a fragment shader. The clouds are burning lumps of smoke, so that colour depends on order. The march
// of OpenGL is compared with its slices, which the hardware blends back to front at the same points.
// Threads: that of the device. Source: Senger2009, 3.3 and 4.2.2.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "methods/contract/experiment.h"

namespace dustbench::grid_fluid::compositing {

/// A ray's sample of a cloud: its colour, and its opacity over a step.
struct Sample {
    glm::vec3 colour{0};
    float opacity = 0;
};

struct Composite {
    glm::vec4 seen{0};  ///< premultiplied
    int samples = 0;    ///< number of samples evaluated
};

/// `samples` are ordered front to back for both. `stopAlpha`: alpha beyond which no further sample is evaluated; 1: all
/// are.
[[nodiscard]] Composite frontToBack(std::span<const Sample> samples, float stopAlpha);
[[nodiscard]] Composite backToFront(std::span<const Sample> samples);

/// The experiment `compositing`, of clouds drawn by the seed. Maximum differences of a channel over all pixels:
///     orders_formulas    the two formulas
///     orders_gl          OpenGL's march and slices
///     orders_wrong       control: the back-to-front formula, given the samples front to back
///     stopped_DEPTH      rays that end beyond an alpha of 0.99, compared with complete ones
/// and the mean share of samples saved by rays through the middle of a cloud:
///     saved_DEPTH        DEPTH: optical depth through the middle, 2, 5, 10, 20, 40
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::compositing
