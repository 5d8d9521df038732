// Packs a particle's cell in the tree, or a voxel, into one word.
#pragma once

#include <cstdint>

namespace dustbench::octree {

/// From the top: 36 bits Morton code of a finest cell, 4 bits rise (levels above the finest), 24 bits particle index. A
/// voxel's code is that of the first finest cell inside it, so that pre-order of voxels is the order of (code,
/// descending rise).
class CellEntry {
 public:
    static constexpr std::uint32_t maximumIndex = (1u << 24) - 1;

    CellEntry() = default;
    explicit CellEntry(std::uint64_t word) : word_(word) {}
    CellEntry(std::uint64_t code, int rise, std::uint32_t index)
        : word_(code << 28 | static_cast<std::uint64_t>(rise) << 24 | index) {}

    [[nodiscard]] std::uint64_t code() const { return word_ >> 28; }
    [[nodiscard]] int rise() const { return static_cast<int>(word_ >> 24 & 0xf); }
    [[nodiscard]] std::uint32_t index() const { return static_cast<std::uint32_t>(word_ & maximumIndex); }
    [[nodiscard]] std::uint64_t word() const { return word_; }
    /// Code of the voxel that contains the particle.
    [[nodiscard]] std::uint64_t voxelCode() const { return code() >> 3 * rise() << 3 * rise(); }
    /// Identifies the voxel: equal for all of its particles, and ascending in pre-order.
    [[nodiscard]] std::uint64_t place() const { return voxelCode() << 4 | static_cast<std::uint64_t>(15 - rise()); }
    bool operator==(const CellEntry&) const = default;

 private:
    std::uint64_t word_;
};

}  // namespace dustbench::octree
