// The pictures compared at one moment: the method's and the ground truth.
//
// Units: linear light; layers premultiplied. Rows from the top.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/export/collected_volume.h"
#include "bench/measure/image/picture.h"
#include "bench/measure/image/popping.h"
#include "bench/reference/particle_image.h"
#include "bench/reference/reference_store.h"
#include "methods/contract/scene.h"
#include "methods/contract/view.h"
#include "methods/contract/volume.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::reference {

/// The method's pictures.
struct DrawnMoment {
    pictures::Image scene;              ///< the opaque scene
    std::vector<float> sceneDepth;      ///< reversed depth
    pictures::Image layer;              ///< the method's dust
    pictures::Image layerWithoutScene;  ///< the same without occlusion by the scene; empty if not requested
};

/// The ground truth.
struct ExactMoment {
    pictures::Image layer;              ///< of the particles themselves
    pictures::Image layerWithoutScene;  ///< empty if not requested
    pictures::Image continuum;          ///< of 64 times as many particles; empty if not requested
    bool ofOneColour = true;            ///< false: the layers have light or colours that the continuum lacks
};

/// Number of continuum particles per particle.
inline constexpr std::int64_t continuumParticles = 64;

/// `dust`: with its colours without light; `scene.lights.onDust` determines whether it is lit. `withDetail`: also
/// renders the layers without the scene. `continuum` may be empty; it is drawn in one colour, without light. Images
/// that `store` has are not rendered.
[[nodiscard]] ExactMoment exactMoment(const scene::Scene& scene, const scene::View& view, const DrawnMoment& drawn,
                                      const Puffs& dust, bool withDetail, const std::optional<Puffs>& continuum,
                                      ReferenceStore& store);

/// The same with sizes in metres (a voxel's edge or a puff's radius) and optical depths.
[[nodiscard]] std::vector<measure::SizedPrimitive> sizedPrimitivesOnScreen(const exports::CollectedVolume& volume,
                                                                           const scene::View& view);
/// Screen positions of puffs, or of voxels as puffs of equal optical depth (edge = 1.2533 r). Primitives behind the eye
/// are omitted.
[[nodiscard]] std::vector<measure::ScreenPrimitive> primitivesOnScreen(const exports::CollectedVolume& volume,
                                                                       const scene::View& view);

}  // namespace dustbench::reference
