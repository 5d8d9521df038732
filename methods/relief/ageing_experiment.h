// How the cost of ageing a surface grows with the numbers of hits and texels, for both search modes (claim R25), and
// how a hit changes the paper's texture (claim R24).
//
// Findings; SEARCH is `gather` or `scatter`, intervals are over seven rounds with different hits:
//     SEARCH_over_hits, SEARCH_over_texels  exponents of the time, over all cells (ageing_cost.h)
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
// Threads: one. Source: Bergeron, 3.4, 4 and 5.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::relief::ageing {

[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::relief::ageing
