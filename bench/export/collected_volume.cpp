#include "bench/export/collected_volume.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "methods/shared/maths/transmittance.h"
#include "methods/shared/particles/particle_store.h"

namespace dustbench::bench {
namespace {

constexpr double paddingDeviations = 4;

void grow(std::optional<Box>& bounds, const Box& box) {
    if (bounds)
        bounds->include(box);
    else
        bounds = box;
}

}  // namespace

void CollectedVolume::puffs(const particles::ParticleStore& puffs) {
    anyPuffs_ = true;
    particles_ = &puffs;
    puffs_.reserve(puffs_.size() + puffs.size());
    for (std::size_t i = 0; i < puffs.size(); ++i) {
        const CollectedPuff puff{puffs.position(i), puffs.radius[i], puffs.opacity[i]};
        const double mass =
            maths::puffMassSquareMetres(static_cast<double>(puff.opacity), static_cast<double>(puff.radiusMetres));
        for (const float number : {puff.centre.x, puff.centre.y, puff.centre.z, static_cast<float>(mass)})
            if (!std::isfinite(number))
                throw std::runtime_error(fmt::format(
                    "particle {}: position ({}, {}, {}), radius {} and opacity {} are not all finite numbers",
                    puffs.serial[i], puff.centre.x, puff.centre.y, puff.centre.z, puff.radiusMetres, puff.opacity));
        if (mass > 0) puffs_.push_back(puff);
    }
}

void CollectedVolume::octree(const OctreeVolume& volume) {
    for (const OctreeVoxel& voxel : volume.voxels) {
        const bool known = voxel.level >= 0 && voxel.level <= volume.depth && volume.depth < 31;
        const std::uint32_t cells = known ? 1u << voxel.level : 0;
        if (voxel.x >= cells || voxel.y >= cells || voxel.z >= cells || !std::isfinite(voxel.extinctionPerMetre))
            throw std::runtime_error(fmt::format(
                "octree voxel ({}, {}, {}) of level {}, extinction {}: lies outside a tree of depth {}, or its "
                "extinction is no finite number",
                voxel.x, voxel.y, voxel.z, voxel.level, voxel.extinctionPerMetre, volume.depth));
    }
    octrees_.push_back({volume.originMetres, volume.edgeMetres, volume.depth, {}});
    octrees_.back().voxels.assign(volume.voxels.begin(), volume.voxels.end());
}

std::optional<Box> CollectedVolume::bounds() const {
    std::optional<Box> bounds;
    for (const CollectedPuff& puff : puffs_) {
        const glm::dvec3 centre(puff.centre);
        const double reach = paddingDeviations * maths::puffDeviationMetres(static_cast<double>(puff.radiusMetres));
        grow(bounds, {centre - reach, centre + reach});
    }
    for (const CollectedOctree& octree : octrees_)
        for (const OctreeVoxel& voxel : octree.voxels) {
            if (voxel.extinctionPerMetre == 0) continue;
            const glm::dvec3 corner = octree.leastCorner(voxel);
            grow(bounds, {corner, corner + octree.cellEdgeMetres(voxel.level)});
        }
    return bounds;
}

}  // namespace dustbench::bench
