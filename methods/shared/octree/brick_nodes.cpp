#include "methods/shared/octree/brick_nodes.h"

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

/// Every node: a voxel, or what has one below it. A word holds the children of the eight cells that are one byte of
/// word >> 3.
void BrickNodes::addParents() {
    nodes_ = bits_;
    for (std::size_t word = nodes_.size() - 1; word >= 1; --word)
        if (nodes_[word] != 0) nodes_[word >> 3] |= anyOfEight(nodes_[word]) << 8 * (word & 7);
    nodes_[0] |= anyOfEight(nodes_[0] & 0xff00);  // the brick's children, bits 8 to 15, to the brick, bit 1
}

void BrickNodes::complete() {
    addParents();
    voxelCount_ = blockCount_ = 0;
    for (const std::uint64_t word : bits_) voxelCount_ += bitCount(word);
    // A block for every eight siblings of which there is one: a byte of the bits.
    for (std::size_t word = 1; word < nodes_.size(); ++word) blockCount_ += bitCount(anyOfEight(nodes_[word]));
    blockCount_ += (nodes_[0] & 0xff00) != 0 ? 1 : 0;
}

struct BrickNodes::Writer {
    const std::uint8_t* voxels;  ///< bytes of the bits: the eight children of cell c are byte c
    const std::uint8_t* nodes;
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
        const std::uint32_t voxelBits = voxels[location];
        for (std::uint32_t left = nodes[location]; left != 0; left &= left - 1) {
            const auto octant = static_cast<std::uint32_t>(std::countr_zero(left));
            const std::uint32_t child = 8 * location + octant;
            NodeSlot& slot = out.slots[octant];
            if (rise == 1 || (voxelBits >> octant & 1)) {
                ranks[child] = static_cast<std::uint16_t>(count++);
                slot.voxel = firstVoxel + count;
            }
            if constexpr (rise > 1) {
                if (nodes[child] == 0) continue;
                slot.children = nextBlock++;
                write<rise - 1>(child, slot.children);
            }
        }
    }
};

void BrickNodes::write(NodeBlock* blocks, std::uint32_t first, std::uint32_t next, std::uint32_t firstVoxel,
                       Ranks& ranks) const {
    static_assert(std::endian::native == std::endian::little, "bytes of a word count from its lowest bits");
    Writer writer{reinterpret_cast<const std::uint8_t*>(bits_.data()),
                  reinterpret_cast<const std::uint8_t*>(nodes_.data()),
                  blocks,
                  next,
                  firstVoxel,
                  ranks.data()};
    if (isVoxel()) ranks[1] = static_cast<std::uint16_t>(writer.count++);
    if (blockCount_ > 0) writer.write<brickRise>(1, first);
}

}  // namespace dustbench::octree
