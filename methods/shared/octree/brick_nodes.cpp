#include "methods/shared/octree/brick_nodes.h"

#include <algorithm>

namespace dustbench::octree {
namespace {

/// One bit for each byte that has any: eight cells to the one above them.
std::uint64_t anyOfEight(std::uint64_t bits) {
    bits |= bits >> 4;
    bits |= bits >> 2;
    bits |= bits >> 1;
    return ((bits & 0x0101'0101'0101'0101ull) * 0x0102'0408'1020'4080ull) >> 56;
}

std::uint32_t bitCount(std::uint64_t bits) {
    return static_cast<std::uint32_t>(std::popcount(bits));
}

}  // namespace

/// Every node: a voxel, or what has one below it. A word holds the children of the eight cells that are one byte of the
/// word whose number has three bits less.
void BrickNodes::addParents() {
    std::copy_n(voxels_.begin(), coarseWords, nodes_.begin());
    for (std::uint32_t word = 0; word < fineWords; ++word)
        nodes_[(64 + word) >> 3] |= anyOfEight(voxels_[coarseWords + word]) << 8 * (word & 7);
    for (std::uint32_t word = coarseWords - 1; word >= 1; --word)
        nodes_[word >> 3] |= anyOfEight(nodes_[word]) << 8 * (word & 7);
    nodes_[0] |= anyOfEight(nodes_[0] & 0xff00);  // the brick's children, bits 8 to 15, to the brick, bit 1
}

void BrickNodes::complete() {
    addParents();
    voxelCount_ = 0;
    for (const std::uint64_t word : voxels_) voxelCount_ += bitCount(word);
    // A block for each cell that has children: for each coarse node but those that are voxels alone.
    blockCount_ = (nodes_[0] & 0xff00) != 0 ? 1 : 0;
    for (std::uint32_t word = 1; word < coarseWords; ++word) blockCount_ += bitCount(anyOfEight(nodes_[word]));
    for (std::uint32_t word = 0; word < fineWords; ++word)
        blockCount_ += bitCount(anyOfEight(voxels_[coarseWords + word]));
}

struct BrickNodes::Writer {
    const std::uint8_t* voxels;  ///< bytes of the bits: the eight children of a coarse cell c are byte c
    const std::uint8_t* nodes;
    const std::uint8_t* fine;  ///< those of the finest cells: the children of cell c are byte c − 512
    NodeBlock* blocks;
    std::uint32_t nextBlock;
    std::uint32_t firstVoxel;
    std::uint16_t* ranks;
    std::uint32_t count = 0;

    /// The children of `location`, whose level lies `rise` above the finest, to `block`; then what is below them.
    template <int rise>
    void write(std::uint32_t location, std::uint32_t block) {
        NodeBlock& out = blocks[block];
        out = NodeBlock{};
        const std::uint32_t voxelBits = rise == 1 ? 0 : voxels[location];
        for (std::uint32_t left = rise == 1 ? fine[location - 512] : nodes[location]; left != 0; left &= left - 1) {
            const auto octant = static_cast<std::uint32_t>(std::countr_zero(left));
            const std::uint32_t child = 8 * location + octant;
            NodeSlot& slot = out.slots[octant];
            if (rise == 1 || (voxelBits >> octant & 1)) {
                ranks[child] = static_cast<std::uint16_t>(count++);
                slot.voxel = firstVoxel + count;
            }
            if constexpr (rise > 1) {
                if ((rise == 2 ? fine[child - 512] : nodes[child]) == 0) continue;
                slot.children = nextBlock++;
                write<rise - 1>(child, slot.children);
            }
        }
    }
};

void BrickNodes::write(NodeBlock* blocks, std::uint32_t first, std::uint32_t next, std::uint32_t firstVoxel,
                       Ranks& ranks) const {
    static_assert(std::endian::native == std::endian::little, "bytes of a word count from its lowest bits");
    const auto* const coarse = reinterpret_cast<const std::uint8_t*>(voxels_.data());
    Writer writer{coarse,
                  reinterpret_cast<const std::uint8_t*>(nodes_.data()),
                  coarse + 8 * coarseWords,
                  blocks,
                  next,
                  firstVoxel,
                  ranks.data()};
    if (isVoxel()) ranks[1] = static_cast<std::uint16_t>(writer.count++);
    if (blockCount_ > 0) writer.write<brickRise>(1, first);
}

}  // namespace dustbench::octree
