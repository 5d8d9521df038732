// A metric's map as a picture: the more, the brighter.
//
// From black over violet, red and orange to pale yellow. Lightness L* rises evenly with the value, so that the order
// holds for readers who tell colours apart badly, and in print without colour.
// Units: the picture is linear light, opaque. Threads: pure.
#pragma once

#include <glm/glm.hpp>

#include "bench/measure/image/plane.h"
#include "methods/shared/draw/image.h"

namespace dustbench::bench {

/// The colour of a share in [0, 1], which is clamped; linear light.
[[nodiscard]] glm::vec3 heatColour(float share);

/// `least` is black, `most` pale yellow. Throws std::invalid_argument where `most` is not above `least`.
[[nodiscard]] draw::Image heatMap(const Plane& map, float least = 0, float most = 1);

}  // namespace dustbench::bench
