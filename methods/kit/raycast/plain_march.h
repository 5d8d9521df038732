// Reference implementation: marches one ray through a grid in double precision; tests compare the fast marches with it.
//
//     D ← D + σ·Δ,   T = e^(−D),   C ← C + (T before − T after)·(reflected + emission)
//
// Steps begin at distances (k + jitter)·step from the eye. The first and the last step are cut to the part within the
// grid and in front of the scene; each is sampled at its middle. Units: cells, relative to the grid's minimum corner.
// Threads: pure.
// Source: Senger2009, ch. 4.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/kit/raycast/light_volume.h"
#include "methods/kit/raycast/raycast_settings.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

struct PlainVolume {
    ShownGrid grid;
    RaycastSettings settings;
    Reflected reflected;
    std::span<const float> light;  ///< per texel of `settings.shadowCells`³ cells; empty: no shadow
};

struct PlainRay {
    glm::dvec3 eye, along;  ///< a unit vector
    double end;             ///< distance to the scene
    double jitter;          ///< fraction of a step
};

/// Red, green, blue, premultiplied, and alpha.
[[nodiscard]] DUSTBENCH_API glm::dvec4 plainMarch(const PlainVolume& volume, const PlainRay& ray);

/// A step of the march.
struct PlainStep {
    double depth = 0;      ///< optical
    glm::dvec3 source{0};  ///< the colour of a thick cloud of this medium
};
/// All steps of a ray, from front to back, at any depth.
[[nodiscard]] DUSTBENCH_API std::vector<PlainStep> plainSteps(const PlainVolume& volume, const PlainRay& ray);

/// Offset of a pixel's steps as a fraction of a step, counted from the bottom left: the fractional part of x/g + y/g²,
/// with 1/g and 1/g² in units of 2⁻³², where g is the plastic number.
[[nodiscard]] double plainJitter(int x, int y);

}  // namespace dustbench::raycast
