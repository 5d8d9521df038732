// Measures the gain of MacCormack advection over semi-Lagrangian advection, in terms of grid refinement (claim R27).
//
// A jet of smoke rises in a closed box. Three runs, semi-Lagrangian (SL) with cells of h and of h/2, and MacCormack
// (MC) with cells of h, are compared with references with cells of h/4, all averaged over the cells of h. Neither
// scheme is neutral, so each provides a reference.
//
// Units: metres, seconds. Threads: the current oneTBB arena; except for times, results do not depend on their number.
// Source: Senger2009, 4.1.1; Selle2008.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "methods/contract/experiment.h"
#include "methods/grid_fluid/flow/advection.h"

namespace dustbench::grid_fluid::scheme_accuracy {

/// The state of the flow in the cells of the coarse grid, x fastest.
struct CoarseFlow {
    std::vector<float> density;
    std::array<std::vector<float>, 3> velocity;  ///< m/s
};

/// A jet with position, direction and strength drawn by `seed`, after `seconds`, in a box of `cells` × 2 `cells` ×
/// `cells`. Each cell is divided into `refinement`³, which are averaged afterwards.
[[nodiscard]] CoarseFlow jetAfter(double seconds, flow::AdvectionScheme scheme, int cells, int refinement,
                                  std::uint64_t seed);

/// How far a flow is from a reference.
struct Distance {
    double density = 0;    ///< ‖a − b‖ / ‖b‖
    double picture = 0;    ///< the same for the density summed along z, as seen from far away
    double velocity = 0;   ///< as for `density`
    double enstrophy = 0;  ///< |log(Σω²(a) / Σω²(b))|
    double detail = 0;     ///< the same for the kinetic energy removed by a mean over 2³ cells
};
[[nodiscard]] Distance distanceOf(const CoarseFlow& flow, const CoarseFlow& reference, int cells);

/// The experiment `scheme_accuracy`, with jets drawn by the seed. Geometric means over the jets, where e(·) is the
/// distance from a reference; MEASURE is a member of Distance, SCHEME (sl or mc) the scheme of the reference:
///     nearer_MEASURE_SCHEME        e(MC, h) / e(SL, h)
///     finer_MEASURE_SCHEME         e(MC, h) / e(SL, h/2)
///     control_MEASURE_SCHEME       e(SL, h) / e(SL, h/2)
///     time_ratio                   processor time of a step, MC / SL, on the grid of h
///     time_ratio_finer             the same, MC on the grid of h / SL on that of h/2
///     bytes_ratio_finer            ratio of the memory of these two solvers
///     …_back                       the inverse
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::scheme_accuracy
