#include "bench/reference/judge/moment_pictures.h"

#include <cmath>

#include "bench/reference/camera_rays.h"
#include "bench/reference/cloud_march.h"
#include "methods/contract/volume.h"
#include "methods/kit/octree/cell_kernel.h"

namespace dustbench::reference {

ExactMoment exactMoment(const scene::Scene& scene, const scene::View& view, const DrawnMoment& drawn, const Puffs& dust,
                        bool withDetail, const std::optional<Puffs>& continuum, ReferenceStore& store) {
    const OpaqueDistances distances = distancesFromDepth(view, drawn.sceneDepth);
    const auto light = scene.lights.onDust ? std::optional(SunLight::of(scene)) : std::nullopt;
    const auto render = [&](const ReferenceOptions& how) { return store.render(dust, view, distances, light, how); };
    ExactMoment exact;
    exact.ofOneColour = !scene.lights.onDust && dust.uniformColour;
    ReferenceOptions options;
    exact.layer = render(options);
    if (withDetail) {
        options.ignoreScene = true;
        exact.layerWithoutScene = render(options);
    }
    if (continuum) {
        options.ignoreScene = false;
        options.opticalDepthShare = 1.0 / continuumParticles;
        Puffs grey = *continuum;
        grey.uniformColour = true;
        exact.continuum = store.render(grey, view, distances, std::nullopt, options);
    }
    return exact;
}

std::vector<measure::SizedPrimitive> sizedPrimitivesOnScreen(const exports::CollectedVolume& volume,
                                                             const scene::View& view) {
    const CameraRays rays(view);
    const double pixelsPerSlope = rays.pixelX(1) - rays.pixelX(0);
    std::vector<measure::SizedPrimitive> primitives;
    const auto add = [&](const glm::dvec3& centre, double radiusMetres, double sizeMetres, double opticalDepth) {
        const glm::dvec3 place = rays.fromWorld(centre);
        if (place.z <= view.camera.nearMetres) return;
        primitives.push_back(
            {{rays.pixelX(place.x / place.z), rays.pixelY(place.y / place.z), radiusMetres / place.z * pixelsPerSlope},
             sizeMetres,
             opticalDepth});
    };
    for (const exports::CollectedPuff& puff : volume.puffs()) {
        const auto radius = static_cast<double>(puff.radiusMetres);
        add(glm::dvec3(puff.centre), radius, radius, -std::log1p(-static_cast<double>(puff.opacity)));
    }
    for (const exports::CollectedOctree& octree : volume.octrees())
        for (const OctreeVoxel& voxel : octree.voxels) {
            const double edge = octree.cellEdgeMetres(voxel.level);
            add(octree.minimumCorner(voxel) + 0.5 * edge, edge / static_cast<double>(octree::edgePerRadius), edge,
                static_cast<double>(voxel.extinctionPerMetre) * edge);
        }
    return primitives;
}

std::vector<measure::ScreenPrimitive> primitivesOnScreen(const exports::CollectedVolume& volume,
                                                         const scene::View& view) {
    std::vector<measure::ScreenPrimitive> primitives;
    for (const measure::SizedPrimitive& each : sizedPrimitivesOnScreen(volume, view)) primitives.push_back(each.place);
    return primitives;
}

}  // namespace dustbench::reference
