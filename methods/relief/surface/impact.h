// One hit of a particle on a relief, and the depth that it adds to a texel.
//
// Units: u, v in texels; depths in steps of DepthMap. Threads: pure.
#pragma once

#include <cmath>
#include <cstdint>

namespace dustbench::relief {

struct Impact {
    float u = 0, v = 0;       ///< texels
    float radiusTexels = 0;   ///< of the changed area; 0: only the nearest texel
    std::uint32_t depth = 0;  ///< change at the centre
};

/// h(ρ) = h₀·(1 − ρ²/r²) of an impact with a radius. Whole steps, so that sums do not depend on the order of the hits.
[[nodiscard]] inline std::uint32_t changeWithin(const Impact& impact, int column, int row) {
    const float du = static_cast<float>(column) - impact.u, dv = static_cast<float>(row) - impact.v;
    const float share = 1 - (du * du + dv * dv) / (impact.radiusTexels * impact.radiusTexels);
    // A signed number of the same value, which processors convert faster; depths end at 2³⁰.
    return static_cast<std::uint32_t>(
        static_cast<std::int32_t>(static_cast<double>(share > 0 ? share : 0) * impact.depth));
}

/// A paraboloid about the hit, or one texel.
[[nodiscard]] inline std::uint32_t changeAt(const Impact& impact, int column, int row) {
    if (impact.radiusTexels > 0) return changeWithin(impact, column, row);
    return std::lround(impact.u) == column && std::lround(impact.v) == row ? impact.depth : 0;
}

}  // namespace dustbench::relief
