// Measures the cost of ageing a surface by numbers of hits and texels, for both searches (claim R25).
//
// Each cell is a surface of side × side texels under random hits of one texel each, as in the paper. `gather` makes a
// test for each hit and each texel; a cell with more than `maximumTests` tests is skipped.
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
    int rounds = 7;       ///< each with different hits
    int reach = 1 << 20;  ///< hits are limited to the lower left corner of `reach` × `reach` texels
};

/// One number of hits on one surface.
struct CostCell {
    int side = 0, hits = 0;
    std::vector<double> seconds;  ///< of each round; empty if the cell was skipped

    [[nodiscard]] double texels() const { return static_cast<double>(side) * side; }
    [[nodiscard]] double tests() const { return texels() * hits; }
};

/// All combinations of sides and numbers of hits, grouped by side.
[[nodiscard]] std::vector<CostCell> measureCost(const CostSweep& sweep);

struct Exponents {
    double overHits = 0, overTexels = 0;
};

/// Exponents of s = c·hitsᵃ·texelsᵇ in one round, by least squares of the logarithms over the measured cells.
[[nodiscard]] Exponents exponentsOf(const std::vector<CostCell>& cells, std::size_t round);

/// The number of texels from which `gather` takes longer than `scatter`, in one round of cells with one number of hits,
/// interpolated logarithmically between cells. NaN if there is no crossover between the first and the last cell.
[[nodiscard]] double crossoverTexels(const std::vector<CostCell>& gather, const std::vector<CostCell>& scatter,
                                     std::size_t round);

}  // namespace dustbench::relief::ageing
