#include "methods/voxel_shape/shape_colours.h"

#include <algorithm>
#include <cmath>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {
namespace {

constexpr std::size_t voxelsABlock = 2048;

PackedColour shown(const glm::vec4& albedo, const glm::vec3& light) {
    return PackedColour(glm::vec4(glm::min(glm::vec3(albedo) * light, glm::vec3(1)), albedo.a));
}

}  // namespace

ShapeLight::ShapeLight(MemoryLedger& ledger, const VoxelGrid& grid, const scene::Lights& lights)
    : lights_(lights),
      albedos_(ledger.account("light")),
      fadingAlbedos_(ledger.account("light")),
      normals_(ledger.account("light")) {
    for (const std::uint32_t i : grid.active()) {
        albedos_.push_back(grid.voxels()[i].colour.colour());
        fadingAlbedos_.push_back(grid.voxels()[i].fadingColour.colour());
    }
    const std::vector<glm::vec3> normals = normalsOf(grid);
    normals_.assign(normals.begin(), normals.end());
}

void ShapeLight::shineOn(VoxelGrid& grid, const Pose& pose) {
    const glm::vec3 toSun = glm::transpose(pose.rotation) * lights_.toSun;
    if (toSun == lastToSun_) return;
    lastToSun_ = toSun;
    const std::span<Voxel> voxels = grid.voxels();
    const std::span<const std::uint32_t> active = grid.active();
    parallel::forEachBlock(active.size(), voxelsABlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t k = first; k < first + count; ++k) {
            const bool hasNormal = normals_[k] != glm::vec3(0);
            const float facing = hasNormal ? std::max(0.0f, glm::dot(normals_[k], toSun)) : 0.5f;
            const glm::vec3 light = lights_.ambient + facing * lights_.sun;
            voxels[active[k]].colour = shown(albedos_[k], light);
            voxels[active[k]].fadingColour = shown(fadingAlbedos_[k], light);
        }
    });
}

ShapeStress::ShapeStress(MemoryLedger& ledger, ShapeSystem& system, const StressLook& look)
    : look_(look),
      colours_(ledger.account("stress")),
      fadingColours_(ledger.account("stress")),
      sums_(ledger.account("stress")),
      displacements_(ledger.account("stress")) {
    const VoxelGrid& grid = system.grid();
    for (const std::uint32_t i : grid.active()) {
        colours_.push_back(grid.voxels()[i].colour.colour());
        fadingColours_.push_back(grid.voxels()[i].fadingColour.colour());
    }
    displacements_.resize(colours_.size());
    system.particles().keepBirthplaces();
}

void ShapeStress::showOn(ShapeSystem& system) {
    const ShapeParticles& particles = system.particles();
    const Pose& pose = system.pose();
    VoxelGrid& grid = system.grid();
    sums_.assign(grid.lattice().size(), {});
    // On one thread: a sum of floats depends on its order.
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.place[i] >= ShapeParticles::outside) continue;
        const glm::vec3 u = pose.toLocal(particles.store.position(i)) - particles.birthplace[i];
        Sum& sum = sums_[particles.place[i]];
        sum.squares += glm::dot(u, u);
        sum.count += 1;
    }
    const auto stressed = [this](const glm::vec4& own, float share) {
        return PackedColour(glm::vec4(glm::mix(glm::vec3(own), look_.colour, share), own.a));
    };
    const std::span<const std::uint32_t> active = grid.active();
    for (std::size_t k = 0; k < active.size(); ++k) {
        const Sum& sum = sums_[active[k]];
        displacements_[k] = sum.count > 0 ? std::sqrt(sum.squares / sum.count) : 0.0f;
        const float share = std::min(1.0f, displacements_[k] / look_.fullMetres);
        grid.voxels()[active[k]].colour = stressed(colours_[k], share);
        grid.voxels()[active[k]].fadingColour = stressed(fadingColours_[k], share);
    }
}

}  // namespace dustbench::voxel_shape
