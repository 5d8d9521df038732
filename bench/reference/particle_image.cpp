#include "bench/reference/particle_image.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "bench/reference/camera_rays.h"
#include "bench/reference/cloud_march.h"
#include "bench/reference/depth_sum.h"
#include "bench/reference/puff_list.h"
#include "methods/contract/volume.h"

namespace dustbench::reference {
namespace {

void demand(bool holds, const char* name, double got, const char* allowed) {
    if (!holds)
        throw std::invalid_argument(fmt::format("ground truth: option {}: got {}, allowed: {}", name, got, allowed));
}

}  // namespace

double CloudImage::alpha(int x, int y) const {
    const auto width = static_cast<std::size_t>(image.width);
    return -std::expm1(-opticalDepths[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)]);
}

void checkOptions(const ReferenceOptions& options) {
    demand(options.opticalDepthShare > 0 && options.opticalDepthShare <= 1, "opticalDepthShare",
           options.opticalDepthShare, "above 0, up to 1");
    demand(options.toleratedDepth >= 1e-12 && options.toleratedDepth <= 1, "toleratedDepth", options.toleratedDepth,
           "1e-12 to 1");
    demand(options.slabMetres >= 1e-4 && std::isfinite(options.slabMetres), "slabMetres", options.slabMetres,
           "1e-4 m or more");
}

CloudImage renderParticles(const Puffs& store, const scene::View& view, const OpaqueDistances& distances,
                           const ReferenceOptions& options) {
    if (!store.uniformColour) return marchParticles(store, view, distances, options);
    checkOptions(options);
    checkDistances(view, distances);
    const CameraRays rays(view);
    const auto puffs =
        preparePuffs(store, rays, options.opticalDepthShare, neglectedDepth(options.toleratedDepth, store.size()));
    DepthSum sum = sumDepths(puffs, rays, options.ignoreScene ? skyDistances(view) : distances);

    CloudImage cloud{{view.width, view.height, {}}, std::move(sum.depths), 0, sum.evaluations};
    cloud.image.pixels.reserve(cloud.opticalDepths.size());
    const glm::dvec3 colour(store.colourOfAll);
    for (const double depth : cloud.opticalDepths) {
        const double alpha = -std::expm1(-depth);
        cloud.image.pixels.emplace_back(glm::dvec4(colour * alpha, alpha));
    }
    return cloud;
}

}  // namespace dustbench::reference
