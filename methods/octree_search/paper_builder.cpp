#include "methods/octree_search/paper_builder.h"

namespace dustbench::octree_search {

using namespace octree;
namespace {

/// A node's slot in the tree, and its Morton code.
struct Place {
    std::uint32_t block = 0;
    std::size_t octant = 0;
    std::uint64_t code = 0;  ///< of the first finest cell inside
};

NodeSlot& slotAt(const Place& place, Octree& tree) {
    return tree.mutableBlocks()[place.block].slots[place.octant];
}

/// Returns the block of a node's children; creates it if it is missing.
std::uint32_t childrenOf(const Place& place, Octree& tree) {
    if (slotAt(place, tree).children == 0) {
        const std::uint32_t added = tree.addBlock();
        slotAt(place, tree).children = added;
    }
    return slotAt(place, tree).children;
}

/// Walks from the root to the node of this level that contains the cell. The bits of the coordinates, the highest
/// first, are the indices of the children (Fig. 3).
Place search(const glm::uvec3& cell, int level, Octree& tree) {
    Place place;
    for (int above = tree.depth() - 1; above >= tree.depth() - level; --above) {
        if (above < tree.depth() - 1) place.block = childrenOf(place, tree);
        const glm::uvec3 bit = cell >> static_cast<unsigned>(above) & 1u;
        place.octant = bit.x << 2 | bit.y << 1 | bit.z;
        place.code |= std::uint64_t{place.octant} << 3 * above;
    }
    return place;
}

/// The separate traversal: lists the voxels of a block and its descendants in pre-order.
class Traversal {
 public:
    Traversal(std::span<const PaperBuilder::Voxel> found, Octree& tree) : found_(found), tree_(tree) {}

    void visit(std::uint32_t block) {
        for (NodeSlot& slot : tree_.mutableBlocks()[block].slots) {
            if (slot.voxel != 0) list(slot);
            if (slot.children != 0) visit(slot.children);
        }
    }

 private:
    void list(NodeSlot& slot) {
        const PaperBuilder::Voxel& voxel = found_[slot.voxel - 1];
        tree_.mutableVoxels()[count_] = voxel.entry;
        if (!tree_.masses().empty()) tree_.mutableMasses()[count_] = voxel.massSquareMetres;
        slot.voxel = ++count_;
    }

    std::span<const PaperBuilder::Voxel> found_;
    Octree& tree_;
    std::uint32_t count_ = 0;
};

}  // namespace

void PaperBuilder::insert(std::uint32_t particle, const ParticlePlace& place, const VoxelRule& rule, Octree& tree) {
    const int level = place.level(particle);
    const glm::uvec3 cell(glm::floor(place.cells(particle)) - place.corner());
    const Place at = search(cell, level, tree);
    NodeSlot& slot = slotAt(at, tree);
    if (slot.voxel == 0) {
        found_.push_back({{}, 0});
        slot.voxel = static_cast<std::uint32_t>(found_.size());
        found_.back().entry = CellEntry(at.code, tree.depth() - level, particle);
    }
    Voxel& voxel = found_[slot.voxel - 1];
    if (rule.wins(particle, voxel.entry.index())) voxel.entry = CellEntry(at.code, voxel.entry.rise(), particle);
    if (rule.accumulates()) voxel.massSquareMetres += rule.massSquareMetres(particle);
}

std::int64_t PaperBuilder::build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                                 Octree& tree) {
    const ParticlePlace place(store, lattice, settings);
    const VoxelRule rule(store, settings.policy);
    const std::int64_t clipped = listActive(store, place, active_);
    tree.clear(settings.depth);
    found_.clear();
    for (const std::uint32_t particle : active_) insert(particle, place, rule, tree);
    tree.setVoxels(found_.size(), rule.accumulates());
    Traversal(found_, tree).visit(0);
    return clipped;
}

}  // namespace dustbench::octree_search
