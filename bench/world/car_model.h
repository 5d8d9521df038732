// The car's mesh: a hatchback and its wheel, built from simple lofted parts to the vehicle's dimensions.
//
// Frame: the vehicle's own (+X forward, +Y up, +Z right, origin on the ground under the rear axle); the wheel's axis is
// +Z, its outer face points to +Z. Units: metres. Colours: linear RGB.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/scene.h"

namespace dustbench::world {

struct CarColours {
    glm::vec3 paint{0.035f, 0.13f, 0.42f};
    glm::vec3 stripe{0.85f, 0.85f, 0.82f};
};

[[nodiscard]] scene::Mesh carBody(const scene::VehicleParameters& parameters, const CarColours& colours);
[[nodiscard]] scene::Mesh carWheel(const scene::VehicleParameters& parameters);

}  // namespace dustbench::world
