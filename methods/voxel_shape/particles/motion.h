// Influences on the motion of all particles of a shape, in addition to the voxels' forces, and the rule for admission
// to voxels.
//
// Units: m, s. Frame: world. Source: JuckelBeckhaus2007, 5.1. Departs: the paper gives no formulas.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace dustbench::voxel_shape {

struct Motion {
    glm::vec3 gravity{0};          ///< acceleration
    glm::vec3 wind{0};             ///< velocity of the air
    float airDragPerSecond = 0;    ///< rate at which a particle's velocity approaches the air's; 0: no air
    float responsePerSecond = 10;  ///< rate at which spirals and helices pull a particle's velocity to their own
    float birthSpeed = 0;          ///< maximum speed of newborns relative to the shape, in a random direction
    float fillSeconds = 0;         ///< time in which a voxel replaces missing particles; 0: at once
    /// Full voxels admit no particle. False, as in the paper: the maximum density limits births only.
    bool fullVoxelsRefuse = true;
};

}  // namespace dustbench::voxel_shape
