// Renders a metric's map as a picture: larger values are brighter.
//
// From black over violet, red and orange to pale yellow. Lightness L* rises linearly with the value, so the order stays
// readable for colour-blind readers and in greyscale print.
// Units: the picture is linear light, opaque. Threads: pure.
#pragma once

#include <glm/glm.hpp>

#include "bench/measure/image/picture.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::measure {

/// Linear light. `share` is clamped to [0, 1].
[[nodiscard]] glm::vec3 heatColour(float share);

/// `minimum` maps to black, `maximum` to pale yellow. Throws std::invalid_argument if `maximum` is not above `minimum`.
[[nodiscard]] pictures::Image heatMap(const Plane& map, float minimum = 0, float maximum = 1);

}  // namespace dustbench::measure
