// The attraction of points by many bodies, the sum over all pairs or with a tree:
//
//     a_i = k·Σ_j m_j·f(s_ij)/s_ij·(x_j − x_i),   s² = |x_j − x_i|² + ε²
//
// The thesis's laws are infinite at d = 0, and 1/log d also at d = 1. Here s = √(d² + ε²) replaces d (Plummer1911): the
// attraction is largest near d = ε, and 0 at the point itself, where its direction is undefined. 1/log d is evaluated
// at 1 + s, which has no pole at 1 and no change of sign. As printed, it is limited to ±20, which it reaches where
// |log s| < 0.05.
//
// Units: m; k in m/s² times what f needs. Threads: pure functions; `AttractionTree` spreads work over the current
// oneTBB arena, and its result does not depend on the number of threads. Source: Thesis, 5.2.2, 5.4.2 and 5.4.3;
// BarnesHut1986.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/kit/maths/fast_functions.h"

namespace dustbench::particles {

enum class AttractionLaw { linear, inverse, inverseSquare, inverseCube, inverseRoot, inverseLog, printedLog };

inline constexpr Choices<AttractionLaw> attractionLaws{{"d", AttractionLaw::linear},
                                                       {"1/d", AttractionLaw::inverse},
                                                       {"1/d2", AttractionLaw::inverseSquare},
                                                       {"1/d3", AttractionLaw::inverseCube},
                                                       {"1/sqrt_d", AttractionLaw::inverseRoot},
                                                       {"1/log_1+d", AttractionLaw::inverseLog},
                                                       {"1/log_d", AttractionLaw::printedLog}};

inline constexpr const char* attractionLawHelp =
    "of the distance d, softened to √(d² + ε²); 1/log_1+d: the logarithm without its pole at 1 m; 1/log_d: as printed, "
    "repels within 1 m, limited to ±20";

/// Returns f(s)/s from s²; its product with r is the attraction.
template <AttractionLaw law>
[[nodiscard]] inline float pullPerMetre(float s2) {
    if constexpr (law == AttractionLaw::linear) return 1.0f;
    if constexpr (law == AttractionLaw::inverse) return 1.0f / s2;
    if constexpr (law == AttractionLaw::inverseSquare) return 1.0f / (s2 * std::sqrt(s2));
    if constexpr (law == AttractionLaw::inverseCube) return 1.0f / (s2 * s2);
    const float s = std::sqrt(s2);
    if constexpr (law == AttractionLaw::inverseRoot) return 1.0f / (s * std::sqrt(s));
    if constexpr (law == AttractionLaw::inverseLog) return 1.0f / (s * maths::naturalLogarithm(1.0f + s));
    const float logarithm = maths::naturalLogarithm(s);
    const float size = std::fabs(logarithm);
    return 1.0f / (s * std::copysign(size > 0.05f ? size : 0.05f, logarithm));
}

/// Calls `action.template operator()<law>()` for the law chosen at run time.
template <typename Action>
void withLaw(AttractionLaw law, const Action& action) {
    switch (law) {
        case AttractionLaw::linear:
            return action.template operator()<AttractionLaw::linear>();
        case AttractionLaw::inverse:
            return action.template operator()<AttractionLaw::inverse>();
        case AttractionLaw::inverseSquare:
            return action.template operator()<AttractionLaw::inverseSquare>();
        case AttractionLaw::inverseCube:
            return action.template operator()<AttractionLaw::inverseCube>();
        case AttractionLaw::inverseRoot:
            return action.template operator()<AttractionLaw::inverseRoot>();
        case AttractionLaw::inverseLog:
            return action.template operator()<AttractionLaw::inverseLog>();
        case AttractionLaw::printedLog:
            return action.template operator()<AttractionLaw::printedLog>();
    }
}

// --- The pull of many bodies. That of a point on itself is 0, because of the softening.

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
