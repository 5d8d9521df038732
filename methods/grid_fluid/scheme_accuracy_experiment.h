// Measures what MacCormack advection gains over semi-Lagrangian, in grids as fine (claim R27).
//
// A jet of smoke rises in a closed box. Three runs, semi-Lagrangian (SL) in a grid of cells h and in one of h/2, and
// MacCormack (MC) in that of h, are compared with references in a grid of h/4, all averaged over the cells of h.
// Neither scheme is neutral, so both give a reference.
//
// Units: metres, seconds. Threads: the current oneTBB arena; the same at any number of them but for the time.
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

/// A jet at a place, in a direction and with a strength that `seed` draws, after `seconds`, in a box of `cells` × 2
/// `cells` × `cells`, each divided into `refinement`³ that are averaged again.
[[nodiscard]] CoarseFlow jetAfter(double seconds, flow::AdvectionScheme scheme, int cells, int refinement,
                                  std::uint64_t seed);

/// How far a flow is from a reference.
struct Distance {
    double density = 0;    ///< ‖a − b‖ / ‖b‖
    double picture = 0;    ///< the same of the density summed along z: what an eye far away sees
    double velocity = 0;   ///< as density
    double enstrophy = 0;  ///< |log(Σω²(a) / Σω²(b))|
    double detail = 0;     ///< the same of the kinetic energy that a mean over 2³ cells takes away
};
[[nodiscard]] Distance distanceOf(const CoarseFlow& flow, const CoarseFlow& reference, int cells);

/// The experiment `scheme_accuracy`, of jets drawn by the seed. With the distance e(·) from a reference, geometric
/// means over the jets; MEASURE is a member of Distance, SCHEME sl or mc, that of the reference:
///     nearer_MEASURE_SCHEME        e(MC, h) / e(SL, h)
///     finer_MEASURE_SCHEME         e(MC, h) / e(SL, h/2)
///     control_MEASURE_SCHEME       e(SL, h) / e(SL, h/2)
///     time_ratio                   processor time of a step, MC to SL, on the grid of h
///     time_ratio_finer             the same, MC on the grid of h to SL on that of h/2
///     bytes_ratio_finer            memory of the solvers of these two
///     …_back                       the other way round
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::scheme_accuracy
