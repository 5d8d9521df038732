#include "methods/octree_recursive/list_builder.h"

#include <algorithm>
#include <array>

#include "methods/contract/volume.h"
#include "methods/kit/octree/voxel_rule.h"

namespace dustbench::octree_recursive {

using namespace octree;
namespace {

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

}  // namespace

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

}  // namespace dustbench::octree_recursive
