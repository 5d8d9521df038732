// The folder of a comparison by error and time: set-ups for other solvers, the flows of all solvers, their times, and
// the resulting table of points.
//
//     times.csv                  problem,cells,solver,scheme,computing_ms: a row for each time a problem was solved
//     points.csv                 a row for each flow and reference (pointColumns)
//     PROBLEM_CELLS/
//       problem.toml             the numbers of the problem
//       begin.flow               the flow at the start (staggered_flow.h)
//       solids.f32, source.f32   32-bit floats, x fastest: 1 in a solid; the amount that a source of strength 1 adds
//       SOLVER-SCHEME.flow       the flow at the end
//
// Other solvers add flows and rows of times.csv. All functions throw InputError with the file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "methods/grid_fluid/precision/grid_problem.h"

namespace dustbench::grid_fluid::precision {

/// The name of our solver.
inline constexpr std::string_view ownSolver = "dustbench";

class PrecisionFolder {
 public:
    /// Creates it if it is missing.
    explicit PrecisionFolder(std::filesystem::path folder);

    void writeSetUp(std::string_view problem, int cells, const GridProblem& set) const;
    [[nodiscard]] bool hasFlow(std::string_view problem, int cells, std::string_view scheme) const;
    void addRun(std::string_view problem, int cells, std::string_view scheme, const SolvedProblem& solved) const;

    /// Writes points.csv and returns the number of its rows. Compares every flow of a problem with each solver's finest
    /// flow, if that has at least `referenceCells` cells across, on the cells of the coarsest grid.
    std::size_t writePoints(int referenceCells) const;

 private:
    [[nodiscard]] std::filesystem::path placeOf(std::string_view problem, int cells) const;

    std::filesystem::path folder_;
};

}  // namespace dustbench::grid_fluid::precision
