// The attraction of points by many bodies: the sum over all pairs, or with a tree.
//
//     a_i = k·Σ_j m_j·f(s_ij)/s_ij·(x_j − x_i),   s² = |x_j − x_i|² + ε²
//
// A point's pull on itself is 0, because of the softening.
// Units: m; k as in attraction_law.h. Threads: pure functions; `AttractionTree` spreads work over the current oneTBB
// arena, and its result does not depend on the number of threads. Source: Thesis, 5.4.2 and 5.4.3; BarnesHut1986.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/kit/particles/attraction_law.h"

namespace dustbench::particles {

struct Attraction {
    AttractionLaw law = AttractionLaw::inverseSquare;
    float strength = 1;
    float softeningMetres = 0.05f;
};

struct Bodies {
    std::span<const float> x, y, z, mass;
};
/// `count` points and where their accelerations are written.
struct Attracted {
    std::size_t count;
    const float *x, *y, *z;
    float *accelerationX, *accelerationY, *accelerationZ;
};

/// Adds the pull of all bodies, in their order: bit-identical for any division of the points.
void addPull(const Attraction& attraction, const Bodies& bodies, const Attracted& points);

/// How distant bodies are treated: combined into one at their centre of mass, or ignored.
enum class FarBodies { centreOfMass, ignored };

/// An octree of bodies. A cell is far from a group of points if edge < angle·distance, the distance from the group's
/// bounding box to the cell's centre of mass; groups are cells of at most 32 bodies.
/// Departs from BarnesHut1986: groups of neighbours share one walk, which makes the angle smaller for most of them.
class AttractionTree {
 public:
    /// Replaces the bodies; all have the mass 1. Memory is kept between builds.
    void build(std::span<const float> x, std::span<const float> y, std::span<const float> z);

    /// Writes the pull on every body, in the order given to `build`.
    void pull(const Attraction& attraction, float openingAngle, FarBodies farBodies, std::span<float> accelerationX,
              std::span<float> accelerationY, std::span<float> accelerationZ) const;

    /// Pairs of a body and a body or cell that `pull` evaluates.
    [[nodiscard]] std::int64_t pairs(float openingAngle, FarBodies farBodies) const;
    [[nodiscard]] std::size_t bytes() const;

 private:
    struct Cell {
        float x, y, z, mass;  ///< centre of mass
        float edge;
        std::uint32_t first, count;  ///< bodies, in the tree's order
        std::uint32_t next;          ///< the cell after this one and all its descendants
        bool isLeaf;
    };
    struct Sum {
        double x = 0, y = 0, z = 0;
    };
    struct Sources;

    Sum addCell(std::uint32_t first, std::uint32_t count, int level, float edge);
    void collect(const Cell& group, float openingAngle, FarBodies farBodies, Sources& sources) const;

    std::vector<Cell> cells_;                                     ///< depth first
    std::vector<std::uint32_t> groups_;                           ///< cells with the points of one walk
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order_;  ///< Morton code and index, sorted
    std::vector<float> x_, y_, z_;                                ///< in the tree's order
};

}  // namespace dustbench::particles
