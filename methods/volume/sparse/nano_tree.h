// A sparse grid of floats in NanoVDB's memory layout, built from the non-empty bricks of 8×8×8 cells of a volume.
//
// Units: cells of the lattice that all moments of a series share; metres where stated. Owns: bricks; the grid, booked
// on a ledger. Threads: const members are safe from any. Source: Museth2021.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::volume {

inline constexpr int brickEdge = 8;
inline constexpr int brickCells = brickEdge * brickEdge * brickEdge;

/// Bricks may lie within ± this many bricks.
inline constexpr int farthestBrick = 1 << 20;

[[nodiscard]] inline std::uint64_t keyOf(const glm::ivec3& brick) {
    const auto part = [](int at) { return static_cast<std::uint64_t>(at + farthestBrick) & 0x1fffff; };
    return part(brick.x) << 42 | part(brick.y) << 21 | part(brick.z);
}
[[nodiscard]] inline glm::ivec3 brickOf(std::uint64_t key) {
    const auto part = [key](int bits) { return static_cast<int>(key >> bits & 0x1fffff) - farthestBrick; };
    return {part(42), part(21), part(0)};
}

/// Bricks while a volume is read or built. A brick at (x, y, z) holds the cells from 8·(x, y, z) on, z fastest, as
/// NanoVDB's leaves do.
class Bricks {
 public:
    using Values = std::array<float, brickCells>;

    /// Null if there is no such brick.
    [[nodiscard]] const Values* find(const glm::ivec3& brick) const {
        const auto found = places_.find(keyOf(brick));
        return found == places_.end() ? nullptr : found->second.get();
    }
    /// Creates a brick of zeros if there is none.
    [[nodiscard]] Values& at(const glm::ivec3& brick) {
        std::unique_ptr<Values>& values = places_[keyOf(brick)];
        if (!values) values = std::make_unique<Values>();
        return *values;
    }
    [[nodiscard]] std::size_t count() const { return places_.size(); }
    [[nodiscard]] const std::unordered_map<std::uint64_t, std::unique_ptr<Values>>& all() const { return places_; }

 private:
    std::unordered_map<std::uint64_t, std::unique_ptr<Values>> places_;
};

/// 512 cells, z fastest: a word for each x.
using CellMask = std::array<std::uint64_t, brickEdge>;

/// A brick of a tree: a leaf, or a tile if it has no values.
struct TreeBrick {
    glm::ivec3 at{0};
    bool isLeaf = false;
    CellMask active{};
    std::size_t source = 0;  ///< an identifier chosen by the builder of the tree
};

/// Cells without a leaf are 0.
///
/// A cell is active if a sample between its centre and those of its upper neighbours may see density: if it or one of
/// its seven upper neighbours has some. A leaf holds 8×8×8 cells, at least one of which has density. A brick with
/// active cells but without density is an active tile of 0. Both marches visit only leaves and tiles.
class NanoTree {
 public:
    explicit NanoTree(MemoryAccount& account) : bytes_(account), leaves_(account), tiles_(account) {}

    /// Lays out these bricks, which must be distinct, and sorts them in the order of the tree. All values are 0.
    /// `spacingMetres` and `originMetres`, the minimum corner of cell (0, 0, 0), are for other programs.
    /// Throws InputError if the tree takes more than `maximumBytes`.
    void lay(std::vector<TreeBrick>& bricks, double spacingMetres, const glm::dvec3& originMetres,
             std::size_t maximumBytes);
    /// The values of leaf number `leaf` in the order of lay().
    [[nodiscard]] float* valuesOf(std::size_t leaf);
    [[nodiscard]] const float* valuesOf(std::size_t leaf) const;
    [[nodiscard]] const glm::ivec3& brickOf(std::size_t leaf) const { return leaves_[leaf]; }
    [[nodiscard]] std::size_t leafCount() const { return leaves_.size(); }

    /// All bricks, in the order of lay(); tiles as if all of their cells were active.
    [[nodiscard]] std::vector<TreeBrick> bricks() const;

    [[nodiscard]] bool empty() const { return bytes_.empty() || leaves_.empty(); }
    /// The grid as a NanoVDB buffer.
    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
    /// The range [minimum, maximum) contains all active cells.
    [[nodiscard]] const glm::ivec3& minimum() const { return minimum_; }
    [[nodiscard]] const glm::ivec3& maximum() const { return maximum_; }
    /// The sum of all values.
    [[nodiscard]] double sum() const;

 private:
    LedgerVector<std::byte> bytes_;
    LedgerVector<glm::ivec3> leaves_, tiles_;  ///< their bricks
    std::size_t leafOffset_ = 0;
    glm::ivec3 minimum_{0}, maximum_{0};
};

/// Builds a tree of densities: a leaf for each brick, and tiles where samples reach into other bricks. Runs in
/// parallel. `spacingMetres`, `originMetres` and `roomBytes` are as in NanoTree::lay.
void plantDensities(const Bricks& densities, double spacingMetres, const glm::dvec3& originMetres,
                    std::size_t roomBytes, NanoTree& tree);

/// The same for any values: all cells of all bricks are active.
void plantAll(const Bricks& values, double spacingMetres, const glm::dvec3& originMetres, std::size_t roomBytes,
              NanoTree& tree);

/// Whether a cell is active on the upper side of a brick, along the axes whose bits (1, 2, 4) are set.
[[nodiscard]] bool touchesAbove(const CellMask& active, int axes);

/// A volume at one moment: the box in which rays are marched, in the world, and trees of density and fire.
struct SparseMoment {
    SparseMoment(MemoryLedger& ledger, std::string_view structure)
        : density(ledger.account(structure)), reaction(ledger.account(structure)) {}

    /// Position and size only, as for a dense grid.
    [[nodiscard]] raycast::ShownGrid place() const { return {cells, spacingMetres, originMetres, {}, {}}; }
    /// Everything visible is in [minimum, maximum), in cells of the box.
    [[nodiscard]] glm::ivec3 minimum() const { return glm::max(density.minimum() - firstCell, glm::ivec3(0)); }
    [[nodiscard]] glm::ivec3 maximum() const { return glm::min(density.maximum() - firstCell + 1, cells); }

    glm::ivec3 cells{0};
    double spacingMetres = 0;
    glm::dvec3 originMetres{0};  ///< minimum corner of the box
    glm::ivec3 firstCell{0};     ///< of the box, on the lattice
    NanoTree density;
    NanoTree reaction;  ///< 1 fresh fire … 0 burnt out; empty: smoke only
};

}  // namespace dustbench::volume
