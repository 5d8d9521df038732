#include "methods/voxel_shape/shape_light.h"

#include <algorithm>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/voxel_shape/voxels/voxel_normals.h"

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

}  // namespace dustbench::voxel_shape
