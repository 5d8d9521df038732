#include "methods/octree_recursive/octree_recursive.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "methods/contract/volume.h"
#include "methods/kit/octree/brick_builder.h"
#include "methods/kit/octree/gpu/gpu_octree_dust.h"
#include "methods/kit/octree/octree_dust.h"
#include "methods/kit/octree/octree_settings.h"
#include "methods/kit/octree/particle_cells.h"

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

class Construction {
 public:
    Construction(ReusedArray<CellEntry>& lists, const VoxelRule& rule, Octree& tree)
        : lists_(lists),
          rule_(rule),
          tree_(tree),
          voxels_(tree.mutableVoxels()),
          masses_(rule.accumulates() ? tree.mutableMasses() : nullptr) {}

    /// Subdivides the node whose children are in `block` and whose list is [begin, end) of the stack; the stack is in
    /// use up to `top`. `shift` moves a child's octant to the lowest bits of a code.
    void subdivide(std::uint32_t block, std::size_t begin, std::size_t end, std::size_t top, int shift) {
        const int childRise = shift / 3;
        std::array<std::size_t, 8> lengths{};
        std::array<std::uint32_t, 8> winners;  // index of a particle + 1; 0: no voxel
        std::array<double, 8> sums{};
        winners.fill(0);
        lists_.extend(top + (end - begin), top);
        const CellEntry* const parents = lists_.data() + begin;
        const std::size_t count = end - begin;

        // Count the lists first, so that all eight are contiguous; then copy.
        for (std::size_t i = 0; i < count; ++i)
            lengths[parents[i].code() >> shift & 7] += parents[i].rise() < childRise ? 1 : 0;
        std::array<std::size_t, 9> starts;
        starts[0] = top;
        for (std::size_t octant = 0; octant < 8; ++octant) starts[octant + 1] = starts[octant] + lengths[octant];
        std::array<CellEntry*, 8> next;
        for (std::size_t octant = 0; octant < 8; ++octant) next[octant] = lists_.data() + starts[octant];
        std::uint64_t code = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const CellEntry entry = parents[i];
            const std::size_t octant = entry.code() >> shift & 7;
            if (entry.rise() < childRise) {
                *next[octant]++ = entry;
                continue;
            }
            code = entry.code();
            if (rule_.accumulates()) sums[octant] += rule_.massSquareMetres(entry.index());
            if (winners[octant] == 0 || rule_.wins(entry.index(), winners[octant] - 1))
                winners[octant] = entry.index() + 1;
        }

        for (std::size_t octant = 0; octant < 8; ++octant) {
            if (winners[octant] != 0) {
                const std::uint64_t voxelCode = ((code >> shift & ~std::uint64_t{7}) | octant) << shift;
                if (masses_) masses_[count_] = sums[octant];
                voxels_[count_++] = CellEntry(voxelCode, childRise, winners[octant] - 1);
                tree_.mutableBlocks()[block].slots[octant].voxel = count_;
            }
            if (lengths[octant] == 0) continue;
            const std::uint32_t children = tree_.addBlock();
            tree_.mutableBlocks()[block].slots[octant].children = children;
            subdivide(children, starts[octant], starts[octant + 1], starts[8], shift - 3);
        }
    }

    [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
    ReusedArray<CellEntry>& lists_;
    const VoxelRule& rule_;
    Octree& tree_;
    CellEntry* voxels_;
    double* masses_;
    std::uint32_t count_ = 0;
};

/// A stable counting sort by seven bits of the place in the brick, which is stored in the entry's code.
void sortByDigit(const CellEntry* from, CellEntry* to, std::uint32_t count, int shift) {
    std::array<std::uint32_t, 128> next{};
    for (std::uint32_t i = 0; i < count; ++i) ++next[from[i].code() >> shift & 127];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0u);
    for (std::uint32_t i = 0; i < count; ++i) to[next[from[i].code() >> shift & 127]++] = from[i];
}

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

std::int64_t ListBuilder::build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                                Octree& tree) {
    const VoxelRule rule(store, settings.policy);
    cells_.find(store, lattice, settings);
    const std::span<const CellEntry> entries = cells_.entries();
    tree.clear(settings.depth);
    tree.setVoxels(entries.size(), rule.accumulates());
    std::ranges::copy(entries, lists_.extend(entries.size(), 0));
    Construction construction(lists_, rule, tree);
    construction.subdivide(0, 0, entries.size(), entries.size(), 3 * (settings.depth - 1));
    tree.setVoxels(construction.count(), rule.accumulates());
    return cells_.clipped();
}

void SortingReducer::reduce(const BrickPartition& partition, const Brick& brick, const BrickVoxels& voxels) {
    CellEntry* const particles = voxels.voxels;
    std::uint32_t total = 0;
    partition.forEachParticle(brick, [&](std::uint64_t key) {
        particles[total++] = CellEntry(partition.key().place(key), 0, partition.key().particle(key));
    });
    sortByDigit(particles, voxels.spare, total, 0);
    sortByDigit(voxels.spare, particles, total, 7);

    PlaceBits taken{};
    std::uint32_t count = 0;
    for (std::uint32_t begin = 0; begin < total;) {
        const auto place = static_cast<std::uint32_t>(particles[begin].code());
        std::uint32_t winner = particles[begin].index();
        double mass = 0;
        std::uint32_t end = begin;
        for (; end < total && particles[end].code() == place; ++end) {
            if (voxels.masses) mass += rule_.massSquareMetres(particles[end].index());
            if (rule_.wins(particles[end].index(), winner)) winner = particles[end].index();
        }
        taken[place / 64] |= std::uint64_t{1} << place % 64;
        if (voxels.masses) voxels.masses[count] = mass;
        particles[count++] = voxelAt(brick, place, winner);
        begin = end;
    }
    voxels.nodes.set(taken);
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Octree dust, recursive";
    info.summary =
        "Splits the list of particles recursively into an octree's cells, and lists the voxels in the same recursion.";
    info.source = "Carr2006";
    info.takesLights = true;
    octree::declareDust(info);
    octree::declareLayout(info,
                          "the paper's construction, with cells computed in advance (lists are split by Morton codes) "
                          "or as printed; or a current one: bricks of 16³ cells in parallel, with sorted Morton codes; "
                          "or, on the GPU, runs of particles sorted by Morton code");
    info.takesGpuDust = octree::isBuiltOnGpu;
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        if (octree::isBuiltOnGpu(values)) return std::make_unique<octree::GpuOctreeDust>(octree::dustSettings(values));
        return std::make_unique<octree::OctreeDust>(
            octree::dustSettings(values),
            [layout = values.choice("layout")](MemoryLedger& ledger) -> std::unique_ptr<octree::OctreeBuilder> {
                if (layout == "paper") return std::make_unique<PaperBuilder>(ledger);
                if (layout == "faithful") return std::make_unique<ListBuilder>(ledger);
                return std::make_unique<octree::BrickBuilder<SortingReducer>>(ledger);
            });
    };
    return info;
}

}  // namespace dustbench::octree_recursive
