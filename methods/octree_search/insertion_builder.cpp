#include "methods/octree_search/insertion_builder.h"
#include "methods/contract/volume.h"

namespace dustbench::octree_search {

using namespace octree;

std::int64_t InsertionBuilder::build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                                     Octree& tree) {
    const VoxelRule rule(store, settings.policy);
    cells_.find(store, lattice, settings);
    tree.clear(settings.depth);
    found_.hold(cells_.entries().size());
    if (rule.accumulates()) foundMasses_.hold(cells_.entries().size());
    list(insertAll(rule, tree), rule.accumulates(), tree);
    return cells_.clipped();
}

std::size_t InsertionBuilder::insertAll(const VoxelRule& rule, Octree& tree) {
    CellEntry* const found = found_.data();
    double* const masses = foundMasses_.data();
    std::uint32_t count = 0;
    for (const CellEntry entry : cells_.entries()) {
        std::uint32_t& voxel = tree.makeNode(entry.code(), entry.rise()).voxel;
        if (voxel == 0) {
            found[count] = entry;
            if (rule.accumulates()) masses[count] = rule.massSquareMetres(entry.index());
            voxel = ++count;
            continue;
        }
        if (rule.accumulates()) masses[voxel - 1] += rule.massSquareMetres(entry.index());
        if (rule.wins(entry.index(), found[voxel - 1].index())) found[voxel - 1] = entry;
    }
    return count;
}

namespace {

/// Walks the whole tree in pre-order and assigns each voxel its position in the list.
struct Lister {
    NodeBlock* blocks;
    const CellEntry* found;
    const double* foundMasses;
    CellEntry* voxels;
    double* masses;  ///< null: not accumulated
    std::uint32_t count = 0;

    void visit(std::uint32_t block) {
        for (NodeSlot& slot : blocks[block].slots) {
            if (slot.voxel != 0) {
                const CellEntry winner = found[slot.voxel - 1];
                voxels[count] = CellEntry(winner.voxelCode(), winner.rise(), winner.index());
                if (masses) masses[count] = foundMasses[slot.voxel - 1];
                slot.voxel = ++count;
            }
            if (slot.children != 0) visit(slot.children);
        }
    }
};

}  // namespace

void InsertionBuilder::list(std::size_t count, bool withMasses, Octree& tree) const {
    tree.setVoxels(count, withMasses);
    Lister{tree.mutableBlocks(), found_.data(), foundMasses_.data(), tree.mutableVoxels(),
           withMasses ? tree.mutableMasses() : nullptr}
        .visit(0);
}

}  // namespace dustbench::octree_search
