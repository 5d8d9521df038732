#include "methods/kit/octree/brick_nodes.h"

#include <bit>
#include <cstring>

#ifdef __BMI2__
#include <immintrin.h>
#endif

#include "methods/kit/octree/bits.h"

namespace dustbench::octree {
namespace {

/// One bit for each byte, set if any bit of the byte is set.
std::uint64_t anyOfEight(std::uint64_t bits) {
    bits |= bits >> 4;
    bits |= bits >> 2;
    bits |= bits >> 1;
    return ((bits & 0x0101'0101'0101'0101ull) * 0x0102'0408'1020'4080ull) >> 56;
}

/// Numbers for the eight slots of a block; the compiler maps them to the available vector registers.
using EightSlots [[gnu::vector_size(64)]] = std::uint64_t;

EightSlots bytesOf(std::uint64_t bytes) {
    const EightSlots shifts = {0, 8, 16, 24, 32, 40, 48, 56};
    return bytes >> shifts & 255;
}

/// Selects `numbers` where `flags` are not 0, else 0.
EightSlots where(EightSlots flags, EightSlots numbers) {
    const EightSlots none{};
    return flags != 0 ? numbers : none;
}

void writeBlock(NodeBlock& block, EightSlots children, EightSlots voxels) {
    static_assert(std::endian::native == std::endian::little, "a slot's first half is the lower one");
    const EightSlots slots = children | voxels << 32;
    std::memcpy(static_cast<void*>(&block), &slots, sizeof(block));
}

/// Extracts four groups of nine places, each a cell followed by its eight finest cells: the bits of the four cells, and
/// the bits of the finest cells as one byte per cell.
struct FourCells {
    std::uint32_t own, finest;
};
FourCells fourCells(std::uint64_t places) {
#ifdef __BMI2__
    return {static_cast<std::uint32_t>(_pext_u64(places, 0x0'0804'0201ull)),
            static_cast<std::uint32_t>(_pext_u64(places, 0xf'f7fb'fdfeull))};
#else
    FourCells cells{};
    for (int k = 0; k < 4; ++k) {
        cells.own |= static_cast<std::uint32_t>(places >> 9 * k & 1) << k;
        cells.finest |= static_cast<std::uint32_t>(places >> (9 * k + 1) & 255) << 8 * k;
    }
    return cells;
#endif
}

/// At least 57 bits, starting at a place.
std::uint64_t bitsFrom(const PlaceBits& bits, std::uint32_t place) {
    std::uint64_t word;
    std::memcpy(&word, reinterpret_cast<const char*>(bits.data()) + place / 8, sizeof(word));
    return word >> place % 8;
}

}  // namespace

void BrickNodes::set(const PlaceBits& voxels) {
    sortByLevel(voxels);
    findNodes();
}

/// Converts the bits from pre-order to level order.
void BrickNodes::sortByLevel(const PlaceBits& voxels) {
    std::fill_n(voxels_.data(), 8, 0);
    voxels_[0] = (bitsFrom(voxels, 1) & 1) << 1;
    std::uint32_t place = 1;
    for (std::uint32_t third = 8; third < 16; ++third) {
        voxels_[0] |= (bitsFrom(voxels, ++place) & 1) << third;
        std::uint64_t second = 0, middle = 0;
        for (std::uint32_t octant = 0; octant < 8; ++octant) {
            const std::uint64_t bits = bitsFrom(voxels, ++place);
            second |= (bits & 1) << octant;
            const FourCells lower = fourCells(bits >> 1), upper = fourCells(bitsFrom(voxels, place + 37));
            middle |= std::uint64_t{upper.own << 4 | lower.own} << 8 * octant;
            voxels_[coarseWords + 8 * (third - 8) + octant] = std::uint64_t{upper.finest} << 32 | lower.finest;
            place += 72;
        }
        voxels_[1] |= second << 8 * (third - 8);
        voxels_[third] = middle;
    }
}

/// Finds all nodes: cells that have a voxel, or contain one. The children of the eight cells in one byte of a word are
/// stored in one word, whose number has three more bits. Each cell has a block unless its children are finest cells.
void BrickNodes::findNodes() {
    voxelCount_ = 0;
    for (const std::uint64_t word : voxels_) voxelCount_ += bitCount(word);
    for (std::uint32_t word = 8; word < coarseWords; ++word) {
        const std::uint64_t above = whichAreSet(&voxels_[coarseWords + 8 * (word - 8)]);
        nodes_[word] = voxels_[word] | above;
    }
    const std::uint64_t aboveThese = whichAreSet(&nodes_[8]);
    nodes_[1] = voxels_[1] | aboveThese;
    const std::uint64_t brickChildren = anyOfEight(nodes_[1]);
    nodes_[0] = voxels_[0] | brickChildren << 8;
    const bool hasChildren = (nodes_[0] & 0xff00) != 0;  // bits 8 to 15
    nodes_[0] |= hasChildren ? 2 : 0;                    // the brick itself, bit 1
    blockCount_ = bitCount(aboveThese) + bitCount(brickChildren) + (hasChildren ? 1 : 0);
}

struct BrickNodes::Writer {
    const std::uint8_t* voxels;  ///< as bytes: byte c has the eight children of the coarse cell c
    const std::uint8_t* nodes;
    const std::uint64_t* fine;  ///< word w: the finest cells in cell 64 + w
    NodeBlock* blocks;
    std::uint32_t nextBlock;
    std::uint32_t nextVoxel;

    /// Writes the children of `location`, which is `rise` levels above the finest, to `block`, then their descendants.
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

    /// Writes the eight children of `location`, each with its finest cells as a family.
    void writeLowest(std::uint32_t location, std::uint32_t block) {
        const std::uint64_t finest = fine[location - 64], own = bitsToBytes(voxels[location]);
        const std::uint64_t before = sumsBefore(byteCounts(finest) + own);
        const EightSlots which = bytesOf(finest), isVoxel = bytesOf(own);
        const EightSlots families = NodeSlot::familyFlag | isVoxel * NodeSlot::ownVoxelFlag | which;
        const std::uint64_t first = nextVoxel + 1;  // a slot stores the index + 1; 0 means none
        writeBlock(blocks[block], where(which, families), where(which | isVoxel, first + bytesOf(before)));
        nextVoxel += bitCount(finest) + bitCount(voxels[location]);
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
