// How the cost of ageing a surface grows with the numbers of hits and texels, for both search modes (claim R25), and
// how a hit changes the paper's texture (claim R24).
//
// Findings; SEARCH is `gather` or `scatter`, intervals are over seven rounds with different hits:
//     SEARCH_over_hits, SEARCH_over_texels  exponents of the time, over all cells (exponentsOf)
//     SEARCH_ms_HITS_SIDE                   the time of a cell, in ms; empty with the reason if it was skipped
//     scatter_in_a_corner_over_hits, …      for hits in a corner of 16² texels, whose memory is local on any surface
//     frame_ms_HITS                         time of `gather` in a frame with 100 to 100,000 hits on 512² texels
//     scattered_frame_ms_1000               the same for `scatter`, a control
//     crossover_texels                      number of texels from which `scatter` takes less time, for 1,000 hits
//     green_lowered                         share of steps in which y falls under the paper's motion
//     velocity_green_lowered                the same for the velocity's y
//     …green_lowered_without_gravity        the same without gravity, controls
//     hit_texels_at_bottom                  share of the texels hit under the paper's ageing whose depth is 1
//     other_texels_changed                  share of the other texels whose depth changed
//
// The quick run has 64² to 256² texels under 512 to 8,192 hits, the full run 256² to 4096² under 10³ to 10⁶.
//
// Each cell is a surface of side × side texels under random hits of one texel each, as in the paper. `gather` makes a
// test for each hit and each texel; a cell with more than `maximumTests` tests is skipped.
//
// Units: s, of the thread's CPU time. Threads: one. Source: Bergeron, 3.4, 4 and 5.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "methods/contract/experiment.h"
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

[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::relief::ageing
