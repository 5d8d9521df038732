#include "methods/dense_grid/grid_builder.h"

#include "methods/kit/octree/particle_place.h"
#include "methods/kit/octree/voxel_rule.h"

namespace dustbench::dense_grid {

using namespace octree;

GridBuilder::GridBuilder(MemoryLedger& ledger)
    : active_(ledger.account("active particles")),
      cells_(ledger.account("dense grid")),
      masses_(ledger.account("dense grid")) {}

void GridBuilder::clear(int depth, bool withMasses) {
    const std::size_t cells = std::size_t{1} << 3 * depth;
    cells_.assign(cells, 0);
    masses_.assign(withMasses ? cells : 0, 0);
}

/// Visits every cell.
void GridBuilder::list(Octree& tree) const {
    std::uint32_t count = 0;
    for (std::uint64_t code = 0; code < cells_.size(); ++code) {
        if (cells_[code] == 0) continue;
        if (!masses_.empty()) tree.mutableMasses()[count] = masses_[code];
        tree.mutableVoxels()[count++] = CellEntry(code, 0, cells_[code] - 1);
    }
}

std::int64_t GridBuilder::build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                                Octree& tree) {
    const ParticlePlace place(store, lattice, settings);
    const VoxelRule rule(store, settings.policy);
    const std::int64_t clipped = listActive(store, place, active_);
    clear(settings.depth, rule.accumulates());
    std::size_t count = 0;
    for (const std::uint32_t particle : active_) {
        const glm::uvec3 at(glm::floor(place.cells(particle)) - place.corner());
        const std::uint64_t code = mortonCode(at.x, at.y, at.z);
        std::uint32_t& cell = cells_[code];
        count += cell == 0 ? 1 : 0;
        if (cell == 0 || rule.wins(particle, cell - 1)) cell = particle + 1;
        if (rule.accumulates()) masses_[code] += rule.massSquareMetres(particle);
    }
    tree.clear(settings.depth);
    tree.setVoxels(count, rule.accumulates());
    list(tree);
    return clipped;
}

std::size_t GridBuilder::structureBytes(const Octree&) const {
    return cells_.size() * sizeof(std::uint32_t) + masses_.size() * sizeof(double);
}

}  // namespace dustbench::dense_grid
