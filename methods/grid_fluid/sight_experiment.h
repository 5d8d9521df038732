// Checks that solids hide a volume correctly and that a camera inside it sees it correctly, by comparing the ray caster
// with the exact solution for a homogeneous box (claim R32).
//
// Units: metres. Threads: that of the device. Source: Senger2009, 4.2.2 and 4.3.1.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "methods/contract/experiment.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/raycast/raycast_settings.h"

namespace dustbench::grid_fluid::sight {

/// A camera on a box of 6 by 3.5 by 4.5 m around the origin, and an opaque ball.
struct Sight {
    struct Ball {
        glm::dvec3 centre{0};
        double radius = 1;
    };
    glm::dvec3 eye{0}, along{0, 0, -1};
    std::optional<Ball> ball;
};

/// The maximum |α − (1 − e^(−σl))| over all pixels; l is the length of a pixel's ray within the box, from the eye to
/// the ball.
[[nodiscard]] double maximumSightError(gpu::Device& device, const raycast::RaycastSettings& settings,
                                       const std::vector<Sight>& sights);

/// The experiment `sight`, with OpenGL's march (`_gl`) and the CPU's (`_cpu`), rays never ending early:
///     free_…      the camera outside, with an unobstructed view
///     solid_…     a ball in front of the box, within it, half within it, behind it
///     inside_…    the camera within the box, so close to it that the near plane cuts its front, and with a ball
///     solid_unseen  control: a ray caster that ignores the ball in front of the box
/// Throws InputError if there is no OpenGL.
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::sight
