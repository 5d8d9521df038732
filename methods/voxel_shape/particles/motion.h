// What moves all particles of a shape besides their voxels' forces, and whom its voxels take in.
//
// Units: m, s. Frame: world. Source: JuckelBeckhaus2007, 5.1. Departs: the paper gives no formulas.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace dustbench::voxel_shape {

struct Motion {
    glm::vec3 gravity{0};          ///< acceleration
    glm::vec3 wind{0};             ///< velocity of the air
    float airDragPerSecond = 0;    ///< rate at which a particle's velocity becomes the air's; 0: no air
    float responsePerSecond = 10;  ///< rate at which spirals and helices draw a particle's velocity to their own
    float birthSpeed = 0;          ///< of newborns relative to the shape, in a random direction, 0 to this
    float fillSeconds = 0;         ///< in which a voxel makes up for the particles that it lacks; 0: at once
    /// Nobody enters a full voxel. False, as in the paper: its maximum density limits births alone.
    bool fullVoxelsRefuse = true;
};

}  // namespace dustbench::voxel_shape
