// A metric's map as a picture: the more, the brighter.
//
// From black over violet, red and orange to pale yellow. Lightness L* rises evenly with the value, so that the order
// holds for readers who tell colours apart badly, and in print without colour.
// Units: the picture is linear light, opaque. Threads: pure.
#pragma once

#include <glm/glm.hpp>

#include "bench/measure/image/plane.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

/// The colour of a share in [0, 1], which is clamped; linear light.
[[nodiscard]] glm::vec3 heatColour(float share);

/// `minimum` is black, `maximum` pale yellow. Throws std::invalid_argument where `maximum` is not above `minimum`.
[[nodiscard]] pictures::Image heatMap(const Plane& map, float minimum = 0, float maximum = 1);

}  // namespace dustbench::bench
