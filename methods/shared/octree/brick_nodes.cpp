#include "methods/shared/octree/brick_nodes.h"

#include <bit>
#include <cstring>

namespace dustbench::octree {
namespace {

constexpr std::uint64_t oneInEachByte = 0x0101'0101'0101'0101ull;

/// One bit for each byte that has any: eight cells to the one above them.
std::uint64_t anyOfEight(std::uint64_t bits) {
    bits |= bits >> 4;
    bits |= bits >> 2;
    bits |= bits >> 1;
    return ((bits & oneInEachByte) * 0x0102'0408'1020'4080ull) >> 56;
}

/// The cells above those of eight words.
std::uint64_t parentsOf(const std::uint64_t* words) {
    std::uint64_t parents = 0;
    for (int i = 0; i < 8; ++i) parents |= anyOfEight(words[i]) << 8 * i;
    return parents;
}

std::uint32_t bitCount(std::uint64_t bits) {
    return static_cast<std::uint32_t>(std::popcount(bits));
}

/// Bit k of eight to byte k.
std::uint64_t toBytes(std::uint64_t bits) {
    return ((bits * oneInEachByte & 0x8040'2010'0804'0201ull) + 0x7f7f'7f7f'7f7f'7f7full) >> 7 & oneInEachByte;
}

/// The bits in each byte.
std::uint64_t byteCounts(std::uint64_t bits) {
    bits -= bits >> 1 & 0x5555'5555'5555'5555ull;
    bits = (bits & 0x3333'3333'3333'3333ull) + (bits >> 2 & 0x3333'3333'3333'3333ull);
    return (bits + (bits >> 4)) & 0x0f0f'0f0f'0f0f'0f0full;
}

/// For each byte the sum of those before it.
std::uint64_t sumsBefore(std::uint64_t bytes) {
    return (bytes * oneInEachByte) << 8;
}

std::uint64_t byteOf(std::uint64_t bytes, int k) {
    return bytes >> 8 * k & 255;
}

/// Numbers for the eight slots of a block; the compiler makes of it what vectors the processor has.
using EightSlots [[gnu::vector_size(64)]] = std::uint64_t;

EightSlots bytesOf(std::uint64_t bytes) {
    const EightSlots shifts = {0, 8, 16, 24, 32, 40, 48, 56};
    return bytes >> shifts & 255;
}

/// `first`, and so many further as each byte of `before` says; 0 where the byte of `present` is 0, not 1.
EightSlots numbersFrom(std::uint64_t first, std::uint64_t before, std::uint64_t present) {
    return (first + bytesOf(before)) & -bytesOf(present);
}

void writeBlock(NodeBlock& block, EightSlots children, EightSlots voxels) {
    static_assert(std::endian::native == std::endian::little, "a slot's first half is the lower one");
    const EightSlots slots = children | voxels << 32;
    std::memcpy(static_cast<void*>(&block), &slots, sizeof(block));
}

}  // namespace

/// Every node: a voxel, or what has one below it. A word holds the children of the eight cells that are one byte of the
/// word whose number has three bits less. A block for each cell that has children.
void BrickNodes::complete() {
    voxelCount_ = 0;
    for (const std::uint64_t word : voxels_) voxelCount_ += bitCount(word);
    blockCount_ = 0;
    for (std::uint32_t word = 8; word < coarseWords; ++word) {
        const std::uint64_t above = parentsOf(&voxels_[coarseWords + 8 * (word - 8)]);
        nodes_[word] = voxels_[word] | above;
        blockCount_ += bitCount(above);
    }
    const std::uint64_t aboveThese = parentsOf(&nodes_[8]);
    nodes_[1] = voxels_[1] | aboveThese;
    const std::uint64_t brickChildren = anyOfEight(nodes_[1]);
    nodes_[0] = voxels_[0] | brickChildren << 8;
    const bool hasChildren = (nodes_[0] & 0xff00) != 0;  // bits 8 to 15
    nodes_[0] |= hasChildren ? 2 : 0;                    // the brick itself, bit 1
    blockCount_ += bitCount(aboveThese) + bitCount(brickChildren) + (hasChildren ? 1 : 0);
}

struct BrickNodes::Writer {
    const std::uint8_t* voxels;  ///< bytes of the bits: the eight children of a coarse cell c are byte c
    const std::uint8_t* nodes;
    const std::uint64_t* fine;  ///< word w: the finest cells in the cell 64 + w
    NodeBlock* blocks;
    std::uint32_t nextBlock;
    std::uint32_t nextVoxel;

    /// The children of `location`, whose level lies `rise` above the finest, to `block`; then what is below them.
    template <int rise>
    void write(std::uint32_t location, std::uint32_t block) {
        NodeBlock& out = blocks[block];
        out = NodeBlock{};
        for (std::uint32_t left = nodes[location]; left != 0; left &= left - 1) {
            const auto octant = static_cast<std::uint32_t>(std::countr_zero(left));
            const std::uint32_t child = 8 * location + octant;
            NodeSlot& slot = out.slots[octant];
            if (voxels[location] >> octant & 1) slot.voxel = ++nextVoxel;
            if (nodes[child] == 0) continue;
            slot.children = nextBlock++;
            if constexpr (rise > 3)
                write<rise - 1>(child, slot.children);
            else
                writeLowest(child, slot.children);
        }
    }

    /// Two levels: the eight children of `location`, and the finest cells in them.
    void writeLowest(std::uint32_t location, std::uint32_t block) {
        const std::uint64_t bits = fine[location - 64];
        std::uint64_t left = anyOfEight(bits);
        const std::uint64_t parents = toBytes(left), middle = toBytes(voxels[location]);
        const std::uint64_t before = sumsBefore(byteCounts(bits) + middle);
        const std::uint64_t first = nextVoxel + 1;  // in a slot 0 means none
        writeBlock(blocks[block], numbersFrom(nextBlock, sumsBefore(parents), parents),
                   numbersFrom(first, before, middle));
        for (; left != 0; left &= left - 1) {
            const int octant = std::countr_zero(left);
            const std::uint64_t cells = toBytes(byteOf(bits, octant));
            writeBlock(blocks[nextBlock++], EightSlots{},
                       numbersFrom(first + byteOf(before + middle, octant), sumsBefore(cells), cells));
        }
        nextVoxel += bitCount(bits) + bitCount(voxels[location]);
    }
};

void BrickNodes::write(NodeBlock* blocks, std::uint32_t first, std::uint32_t next, std::uint32_t firstVoxel) const {
    static_assert(std::endian::native == std::endian::little, "bytes of a word count from its lowest bits");
    if (blockCount_ == 0) return;
    Writer writer{reinterpret_cast<const std::uint8_t*>(voxels_.data()),
                  reinterpret_cast<const std::uint8_t*>(nodes_.data()),
                  voxels_.data() + coarseWords,
                  blocks,
                  next,
                  firstVoxel + (isVoxel() ? 1 : 0)};
    writer.write<brickRise>(1, first);
}

}  // namespace dustbench::octree
