// What is judged of one moment: a method's pictures of it, and the exact ones.
//
// Units: linear light; layers premultiplied. Rows from the top.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/export/collected_volume.h"
#include "bench/measure/image/screen_primitive.h"
#include "bench/reference/particle_image.h"
#include "methods/contract/view.h"
#include "methods/contract/volume.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

/// As a method drew it.
struct DrawnMoment {
    pictures::Image scene;              ///< the opaque scene
    std::vector<float> sceneDepth;      ///< reversed
    pictures::Image layer;              ///< the method's dust
    pictures::Image layerWithoutScene;  ///< the same as if nothing stood before it; empty where it was not asked for
};

/// As it is.
struct ExactMoment {
    pictures::Image layer;              ///< of the particles themselves
    pictures::Image layerWithoutScene;  ///< empty where it was not asked for
    pictures::Image continuum;          ///< of 64 times as many; empty where it was not asked for
};

/// Whose particles the continuum is made of.
inline constexpr std::int64_t continuumParticles = 64;

/// `withDetail`: the layers without the scene as well. `continuum` may be empty.
[[nodiscard]] ExactMoment exactMoment(const scene::View& view, const DrawnMoment& drawn, const Puffs& dust,
                                      bool withDetail, const std::optional<Puffs>& continuum);

/// Puffs, or voxels as the puffs of their optical depth (edge = 1.2533 r), as the view shows them; those behind the eye
/// are left out.
[[nodiscard]] std::vector<ScreenPrimitive> primitivesOnScreen(const CollectedVolume& volume, const scene::View& view);

}  // namespace dustbench::bench
