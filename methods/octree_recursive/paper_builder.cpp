#include "methods/octree_recursive/paper_builder.h"

#include <array>

#include "methods/kit/octree/particle_place.h"
#include "methods/kit/octree/voxel_rule.h"

namespace dustbench::octree_recursive {

using namespace octree;
namespace {

/// A node that is subdivided.
struct Node {
    glm::dvec3 corner;  ///< minimum corner, in finest cells
    double edge;
    int level;
    std::uint64_t code;   ///< of the first finest cell inside
    std::uint32_t block;  ///< holds its children
};

/// The state of one cube as determined by its particles.
struct Voxel {
    bool exists = false;
    std::uint32_t particle = 0;  ///< that represents it
    double massSquareMetres = 0;
};

class PaperConstruction {
 public:
    PaperConstruction(const ParticlePlace& place, const VoxelRule& rule, std::vector<PaperBuilder::List>& lists,
                      Octree& tree)
        : place_(place), rule_(rule), lists_(lists), tree_(tree) {}

    /// Steps 2 to 4 of the paper.
    void subdivide(const Node& node, const PaperBuilder::List& particles) {
        PaperBuilder::List* const lists = &lists_[8 * static_cast<std::size_t>(node.level + 1)];
        for (std::size_t cube = 0; cube < 8; ++cube) lists[cube].clear();
        std::array<Voxel, 8> voxels;

        for (const std::uint32_t particle : particles) {
            const std::size_t cube = cubeOf(place_.cells(particle), node);
            if (place_.level(particle) == node.level + 1)  // always true at the bottommost level
                assign(particle, voxels[cube]);
            else
                lists[cube].push_back(particle);
        }

        for (std::size_t cube = 0; cube < 8; ++cube) {
            Node child = childOf(node, cube);
            if (voxels[cube].exists) list(voxels[cube], child, slot(node, cube));
            if (lists[cube].empty()) continue;
            slot(node, cube).children = child.block = tree_.addBlock();
            subdivide(child, lists[cube]);
        }
    }

    [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
    /// 4·x + 2·y + z, each 1 beyond the node's middle.
    static std::size_t cubeOf(const glm::dvec3& particle, const Node& node) {
        const glm::dvec3 middle = node.corner + node.edge / 2;
        return (particle.x >= middle.x ? 4u : 0u) + (particle.y >= middle.y ? 2u : 0u) +
               (particle.z >= middle.z ? 1u : 0u);
    }
    [[nodiscard]] Node childOf(const Node& node, std::size_t cube) const {
        const double edge = node.edge / 2;
        const glm::dvec3 side(cube >> 2 & 1, cube >> 1 & 1, cube & 1);
        const int rise = tree_.depth() - (node.level + 1);
        return {node.corner + edge * side, edge, node.level + 1, node.code | std::uint64_t{cube} << 3 * rise, 0};
    }
    void assign(std::uint32_t particle, Voxel& voxel) const {
        if (!voxel.exists || rule_.wins(particle, voxel.particle)) voxel.particle = particle;
        voxel.exists = true;
        if (rule_.accumulates()) voxel.massSquareMetres += rule_.massSquareMetres(particle);
    }
    /// Appends a voxel to the list of rendered voxels.
    void list(const Voxel& voxel, const Node& node, NodeSlot& slot) {
        if (rule_.accumulates()) tree_.mutableMasses()[count_] = voxel.massSquareMetres;
        tree_.mutableVoxels()[count_++] = CellEntry(node.code, tree_.depth() - node.level, voxel.particle);
        slot.voxel = count_;
    }
    /// Valid until a block is added.
    [[nodiscard]] NodeSlot& slot(const Node& node, std::size_t cube) {
        return tree_.mutableBlocks()[node.block].slots[cube];
    }

    const ParticlePlace& place_;
    const VoxelRule& rule_;
    std::vector<PaperBuilder::List>& lists_;
    Octree& tree_;
    std::uint32_t count_ = 0;
};

}  // namespace

PaperBuilder::PaperBuilder(MemoryLedger& ledger) : active_(ledger.account("octree particle lists")) {
    for (int i = 0; i < 8 * (maximumDepth + 1); ++i) lists_.emplace_back(ledger.account("octree particle lists"));
}

std::int64_t PaperBuilder::build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                                 Octree& tree) {
    const ParticlePlace place(store, lattice, settings);
    const VoxelRule rule(store, settings.policy);
    const std::int64_t clipped = listActive(store, place, active_);
    tree.clear(settings.depth);
    tree.setVoxels(active_.size(), rule.accumulates());
    PaperConstruction construction(place, rule, lists_, tree);
    construction.subdivide({place.corner(), place.edge(), 0, 0, 0}, active_);
    tree.setVoxels(construction.count(), rule.accumulates());
    return clipped;
}

}  // namespace dustbench::octree_recursive
