// One ray through a grid, as its equations say it, in double precision: what the marches are held against.
//
//     D ← D + σ·Δ,   T = e^(−D),   C ← C + (T before − T after)·(reflected + emission)
//
// Steps begin at distances (k + jitter)·step from the eye; the first and the last are cut to what lies within the grid
// and before the scene, and each is sampled in its middle. Units: cells, from the grid's minimum corner. Threads: pure.
// Source: Senger2009, ch. 4.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "methods/kit/raycast/light_volume.h"
#include "methods/kit/raycast/raycast_settings.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

struct PlainVolume {
    ShownGrid grid;
    RaycastSettings settings;
    Reflected reflected;
    std::span<const float> light;  ///< of texels of so many cells as `settings` have for a shadow; empty: no shadow
};

struct PlainRay {
    glm::dvec3 eye, along;  ///< a unit vector
    double end;             ///< distance of the scene
    double jitter;          ///< share of a step
};

/// Red, green, blue, premultiplied, and alpha.
[[nodiscard]] glm::dvec4 plainMarch(const PlainVolume& volume, const PlainRay& ray);

/// The share of a step by which a pixel's steps are shifted, counted from the bottom left: x/g + y/g² without the whole
/// part, 1/g and 1/g² in units of 2⁻³², g the plastic number.
[[nodiscard]] double plainJitter(int x, int y);

}  // namespace dustbench::raycast
