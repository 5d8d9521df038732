// The lattice of the octree's world: a cube halved `depth` times along each axis, with Morton codes of its cells.
//
// Units: metres. Frame: world. A cell of level l (0: the whole cube) has edge `edge / 2^l`. Its code has 3·l bits; the
// top three select the root's child: bit 2 is x, bit 1 is y, bit 0 is z. The finest cells lie at multiples of their
// edge from the world's origin, so that they stay fixed when the cube moves by whole cells.
// Source: Carr2006, Fig. 3.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace dustbench::octree {

inline constexpr int minimumDepth = 4;
inline constexpr int maximumDepth = 12;

struct Lattice {
    glm::dvec3 origin{0};  ///< minimum corner; a multiple of the finest edge
    double edgeMetres = 128;
    int depth = 8;

    /// The number of finest cells, or of cells of another level.
    [[nodiscard]] std::uint32_t cellsPerEdge() const { return cellsPerEdge(depth); }
    [[nodiscard]] static std::uint32_t cellsPerEdge(int level) { return 1u << level; }
    [[nodiscard]] double cellEdgeMetres(int level) const { return edgeMetres / static_cast<double>(1u << level); }
    /// Number of the first finest cell along each axis, counted from the world's origin.
    [[nodiscard]] glm::ivec3 firstCell() const { return glm::round(origin / cellEdgeMetres(depth)); }
    bool operator==(const Lattice&) const = default;
};

/// Moves bit k of a number below 2^12 to bit 3·k.
[[nodiscard]] constexpr std::uint64_t spreadBits(std::uint64_t x) {
    x = (x | x << 16) & 0x0000'0000'ff00'00ffull;
    x = (x | x << 8) & 0x0000'000f'00f0'0f00full;
    x = (x | x << 4) & 0x0000'00c3'0c30'c30c3ull;
    x = (x | x << 2) & 0x0000'0249'2492'49249ull;
    return x;
}

/// Moves bit 3·k to bit k: the inverse of `spreadBits`; ignores other bits.
[[nodiscard]] constexpr std::uint32_t gatherBits(std::uint64_t x) {
    x &= 0x0000'0249'2492'49249ull;
    x = (x | x >> 2) & 0x0000'00c3'0c30'c30c3ull;
    x = (x | x >> 4) & 0x0000'000f'00f0'0f00full;
    x = (x | x >> 8) & 0x0000'0000'ff00'00ffull;
    x = (x | x >> 16) & 0xfffull;
    return static_cast<std::uint32_t>(x);
}

[[nodiscard]] constexpr std::uint64_t mortonCode(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return spreadBits(x) << 2 | spreadBits(y) << 1 | spreadBits(z);
}

[[nodiscard]] constexpr glm::uvec3 mortonCell(std::uint64_t code) {
    return {gatherBits(code >> 2), gatherBits(code >> 1), gatherBits(code)};
}

/// Places the octree's world: a cube that moves in whole steps, so that its lattice stays fixed in space. Returns the
/// minimum corner of the cube of edge `edgeMetres` around `centre`, moved in steps of `stepMetres` (the coarsest
/// voxel's edge). On level ground the cube's centre is at y = 0. Throws std::invalid_argument unless 0 < stepMetres ≤
/// edgeMetres.
[[nodiscard]] glm::dvec3 octreeWorldOrigin(const glm::dvec3& centre, double edgeMetres, double stepMetres);

}  // namespace dustbench::octree
