#include "methods/volume/sparse/brick_trees.h"

#include <algorithm>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::volume {
namespace {

// A word's bit 8·y + z is the cell (y, z).

constexpr std::uint64_t firstOfRows = 0x0101010101010101ull;

CellMask cellsWithDensity(const Bricks::Values& values) {
    CellMask mask{};
    for (int i = 0; i < brickCells; ++i)
        mask[static_cast<std::size_t>(i / 64)] |= std::uint64_t{values[static_cast<std::size_t>(i)] != 0} << (i % 64);
    return mask;
}

/// Also sets the cells directly below the set ones along an axis; `above` is the next brick upwards.
CellMask spreadX(const CellMask& mask, const CellMask& above) {
    CellMask spread = mask;
    for (std::size_t x = 0; x < 8; ++x) spread[x] |= x < 7 ? mask[x + 1] : above[0];
    return spread;
}
CellMask spreadY(const CellMask& mask, const CellMask& above) {
    CellMask spread = mask;
    for (std::size_t x = 0; x < 8; ++x) spread[x] |= mask[x] >> 8 | above[x] << 56;
    return spread;
}
CellMask spreadZ(const CellMask& mask, const CellMask& above) {
    CellMask spread = mask;
    for (std::size_t x = 0; x < 8; ++x) spread[x] |= (mask[x] & ~firstOfRows) >> 1 | (above[x] & firstOfRows) << 7;
    return spread;
}

bool any(const CellMask& mask) {
    return std::ranges::any_of(mask, [](std::uint64_t word) { return word != 0; });
}

/// The bricks of a tree for these densities. Fills `order`; a leaf's `source` is its index there.
std::vector<TreeBrick> treeBricks(const Bricks& densities, std::vector<std::uint64_t>& order) {
    for (const auto& [key, values] : densities.all()) order.push_back(key);
    std::vector<CellMask> filled(order.size());
    parallel::forEachBlock(order.size(), 256, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i)
            filled[i] = cellsWithDensity(*densities.find(brickOf(order[i])));
    });
    std::unordered_map<std::uint64_t, std::size_t> places;
    places.reserve(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) places.emplace(order[i], i);

    // All bricks that samples can read: those with density, and the seven below each.
    std::vector<TreeBrick> bricks;
    std::unordered_map<std::uint64_t, bool> seen;
    seen.reserve(2 * order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const glm::ivec3 brick = brickOf(order[i]);
        for (int n = 0; n < 8; ++n) {
            const glm::ivec3 below = brick - glm::ivec3(n & 1, n >> 1 & 1, n >> 2);
            if (!seen.emplace(keyOf(below), true).second) continue;
            const auto own = places.find(keyOf(below));
            TreeBrick& made = bricks.emplace_back();
            made.at = below;
            made.isLeaf = own != places.end();
            if (made.isLeaf) made.source = own->second;
        }
    }
    parallel::forEachBlock(bricks.size(), 256, [&](std::size_t first, std::size_t count) {
        for (std::size_t b = first; b < first + count; ++b) {
            const auto maskOf = [&](int x, int y, int z) {
                const auto found = places.find(keyOf(bricks[b].at + glm::ivec3(x, y, z)));
                return found == places.end() ? CellMask{} : filled[found->second];
            };
            std::array<CellMask, 4> alongZ;  // of the four columns (x, y)
            for (int n = 0; n < 4; ++n)
                alongZ[static_cast<std::size_t>(n)] = spreadZ(maskOf(n & 1, n >> 1, 0), maskOf(n & 1, n >> 1, 1));
            bricks[b].active = spreadX(spreadY(alongZ[0], alongZ[2]), spreadY(alongZ[1], alongZ[3]));
        }
    });
    std::erase_if(bricks, [](const TreeBrick& brick) { return !brick.isLeaf && !any(brick.active); });
    return bricks;
}

/// Lays out these bricks and copies their values; a leaf's `source` is its index in `order`.
void plant(const Bricks& values, std::vector<TreeBrick> bricks, const std::vector<std::uint64_t>& order,
           double spacingMetres, const glm::dvec3& originMetres, std::size_t roomBytes, NanoTree& tree) {
    tree.lay(bricks, spacingMetres, originMetres, roomBytes);
    std::size_t leaf = 0;
    for (const TreeBrick& brick : bricks)
        if (brick.isLeaf) std::ranges::copy(*values.find(brickOf(order[brick.source])), tree.valuesOf(leaf++));
}

}  // namespace

void plantDensities(const Bricks& densities, double spacingMetres, const glm::dvec3& originMetres,
                    std::size_t roomBytes, NanoTree& tree) {
    std::vector<std::uint64_t> order;
    std::vector<TreeBrick> bricks = treeBricks(densities, order);
    plant(densities, std::move(bricks), order, spacingMetres, originMetres, roomBytes, tree);
}

void plantAll(const Bricks& values, double spacingMetres, const glm::dvec3& originMetres, std::size_t roomBytes,
              NanoTree& tree) {
    std::vector<std::uint64_t> order;
    std::vector<TreeBrick> bricks;
    for (const auto& [key, ignored] : values.all()) {
        bricks.push_back({brickOf(key), true, {}, order.size()});
        bricks.back().active.fill(~std::uint64_t{0});
        order.push_back(key);
    }
    plant(values, std::move(bricks), order, spacingMetres, originMetres, roomBytes, tree);
}

bool touchesAbove(const CellMask& active, int axes) {
    std::uint64_t cells = ~std::uint64_t{0};
    if (axes & 2) cells &= 0xffull << 56;
    if (axes & 4) cells &= 0x8080808080808080ull;
    for (std::size_t x = axes & 1 ? 7 : 0; x < 8; ++x)
        if (active[x] & cells) return true;
    return false;
}

}  // namespace dustbench::volume
