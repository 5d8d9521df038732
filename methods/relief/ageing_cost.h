// What it costs to age a surface, over the numbers of hits and of texels, by both searches (claim R25).
//
// Each cell is a surface of side × side texels under random hits of one texel each, as in the paper. `gather` makes a
// test for each hit and each texel; a cell of more than `maximumTests` of them is skipped.
//
// Units: s, of the thread's CPU time. Threads: one. Source: Bergeron, 3.4 and 5.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "methods/relief/living_relief.h"

namespace dustbench::relief::ageing {

constexpr double maximumTests = 1e11;

/// A surface of side × side texels, all at half of its depth.
[[nodiscard]] scene::Relief flatRelief(int side);

struct CostSweep {
    Search search = Search::gather;
    std::vector<int> sides, hits;
    std::uint64_t seed = 1;
    int rounds = 7;       ///< each with other hits
    int reach = 1 << 20;  ///< hits lie within the lower left corner of so many texels a side
};

/// One number of hits on one surface.
struct CostCell {
    int side = 0, hits = 0;
    std::vector<double> seconds;  ///< of each round; empty if the cell was skipped

    [[nodiscard]] double texels() const { return static_cast<double>(side) * side; }
    [[nodiscard]] double tests() const { return texels() * hits; }
};

/// Cells side by side for each number of hits.
[[nodiscard]] std::vector<CostCell> measureCost(const CostSweep& sweep);

struct Exponents {
    double overHits = 0, overTexels = 0;
};

/// Exponents of s = c·hitsᵃ·texelsᵇ in one round, by least squares of the logarithms over the cells that have one.
[[nodiscard]] Exponents exponentsOf(const std::vector<CostCell>& cells, std::size_t round);

/// The number of texels at which `gather` begins to take longer than `scatter`, in one round of cells of one number of
/// hits each; between cells by the logarithms. NaN if it does not happen between the first and the last.
[[nodiscard]] double crossoverTexels(const std::vector<CostCell>& gather, const std::vector<CostCell>& scatter,
                                     std::size_t round);

}  // namespace dustbench::relief::ageing
