#include "methods/voxel_shape/shape_stress.h"

#include <algorithm>
#include <cmath>

namespace dustbench::voxel_shape {

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
