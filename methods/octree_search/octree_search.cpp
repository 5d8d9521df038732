#include "methods/octree_search/octree_search.h"

#include <algorithm>

#include "methods/contract/volume.h"
#include "methods/kit/octree/bits.h"
#include "methods/kit/octree/brick_builder.h"
#include "methods/kit/octree/gpu/gpu_octree_dust.h"
#include "methods/kit/octree/octree_dust.h"

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

void InsertionBuilder::list(std::size_t count, bool withMasses, Octree& tree) const {
    tree.setVoxels(count, withMasses);
    Lister{tree.mutableBlocks(), found_.data(), foundMasses_.data(), tree.mutableVoxels(),
           withMasses ? tree.mutableMasses() : nullptr}
        .visit(0);
}

void GridReducer::reduce(const BrickPartition& partition, const Brick& brick, const BrickVoxels& voxels) {
    const BrickKey word = partition.key();
    partition.forEachParticle(brick, [&](std::uint64_t key) {
        const std::uint32_t place = word.place(key);
        const std::uint64_t holder = best_[place];
        std::uint64_t best = std::max(holder, key);
        if (word.samePriority(holder, key) && holder != 0)  // rare: the word does not contain enough bits to decide
            best = rule_.wins(word.particle(key), word.particle(holder)) ? key : holder;
        best_[place] = best;
        isTaken_[place] = 1;
    });

    PlaceBits taken;
    for (std::size_t i = 0; i < taken.size(); ++i) taken[i] = whichAreSet(&isTaken_[64 * i]);
    isTaken_.fill(0);
    voxels.nodes.set(taken);
    const std::uint32_t count = numbersOfBits(taken, taken_.data());
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t place = taken_[i];
        voxels.voxels[i] = voxelAt(brick, place, word.particle(best_[place]));
        best_[place] = 0;
    }

    if (voxels.masses) {
        for (std::uint32_t i = 0; i < count; ++i) sums_[taken_[i]] = 0;
        partition.forEachParticle(
            brick, [&](std::uint64_t key) { sums_[word.place(key)] += rule_.massSquareMetres(word.particle(key)); });
        for (std::uint32_t i = 0; i < count; ++i) voxels.masses[i] = sums_[taken_[i]];
    }
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Octree dust, search";
    info.summary =
        "Inserts each particle into an octree by searching from the root, and lists the voxels in one traversal.";
    info.source = "Carr2006";
    info.takesLights = true;
    octree::declareDust(info);
    octree::declareLayout(info,
                          "the paper's construction, with cells computed in advance (Morton codes are the paths) or as "
                          "printed; or a current one: bricks of 16³ cells in parallel, with a small grid each; or, on "
                          "the GPU, runs of particles sorted by Morton code");
    info.takesGpuDust = octree::isBuiltOnGpu;
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        if (octree::isBuiltOnGpu(values)) return std::make_unique<octree::GpuOctreeDust>(octree::dustSettings(values));
        return std::make_unique<octree::OctreeDust>(
            octree::dustSettings(values),
            [layout = values.choice("layout")](MemoryLedger& ledger) -> std::unique_ptr<octree::OctreeBuilder> {
                if (layout == "paper") return std::make_unique<PaperBuilder>(ledger);
                if (layout == "faithful") return std::make_unique<InsertionBuilder>(ledger);
                return std::make_unique<octree::BrickBuilder<GridReducer>>(ledger);
            });
    };
    return info;
}

}  // namespace dustbench::octree_search
