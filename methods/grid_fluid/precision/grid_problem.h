// Three problems on which fluid solvers are compared by error and time (reports/guide/work-precision.md). All of their
// numbers are here and in grid_problem.cpp.
//
//     plume   hot smoke rises past a ball in a closed box, 1.92 s
//     ring    a vortex ring that carries smoke meets the wall of a closed box, 1.2 s
//     car     wind flows around the car in a tunnel with walls, smoke in front of its nose, 0.5 s; air enters and
//             leaves at the wind's speed, so that results do not depend on a solver's open sides
//
// The step of a problem is proportional to the cell size of its grid. The initial flow is divergence-free on that grid.
// Units: SI. Frame: the box's minimum corner is the origin. Threads: rows in blocks. Source: Rosenhead1930 (the
// softened kernel of the vortex ring).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/grid_fluid/flow/solver.h"
#include "methods/grid_fluid/precision/staggered_flow.h"

namespace dustbench::grid_fluid::precision {

/// A vortex ring as an initial flow. It moves towards +x.
///
/// Its vector potential is that of a thin ring whose kernel is softened by the core's radius; the speed of a face is
/// the circulation of the potential around it, so the flow is divergence-free except for rounding.
struct VortexRing {
    glm::dvec3 centreMetres{0};
    double radiusMetres = 1;
    double coreMetres = 0.1;
    double circulationM2PerSecond = 1;

    /// Radius to the centre of the core.
    [[nodiscard]] double distanceMetres(const glm::dvec3& place) const;
};

/// Sets the speeds of all faces and ignores walls.
void addRing(const VortexRing& ring, const flow::FluidBox& box, StaggeredFlow& flow);

enum class ProblemKind : std::uint8_t { plume, ring, car };
inline constexpr Choices<ProblemKind> problemKinds{
    {"plume", ProblemKind::plume}, {"ring", ProblemKind::ring}, {"car", ProblemKind::car}};

struct GridProblem {
    /// Whether the centres of a box's cells are in the car, x fastest. The box is the tunnel, whose origin is here
    /// relative to the car: on the ground under its rear axle, x ahead.
    using CarCells = std::function<std::vector<std::uint8_t>(const flow::FluidBox&)>;

    flow::FluidSettings settings;
    std::vector<flow::FluidSource> sources;  ///< at most one
    std::vector<std::uint8_t> solids;        ///< 1 in a solid; empty: there is none
    StaggeredFlow begin;
    double stepSeconds = 0;
    int steps = 0;

    [[nodiscard]] double seconds() const { return stepSeconds * steps; }
};

/// Throws InputError unless it is a multiple of 8 from 8 to 256.
void checkCells(int cellsAcross);
/// Throws InputError as checkCells does. `car` is called only for the problem `car`.
[[nodiscard]] GridProblem problemOn(ProblemKind kind, int cellsAcross, const GridProblem::CarCells& car);

/// The change that a source of strength 1 makes to each cell, x fastest; 0 in solids.
[[nodiscard]] std::vector<float> strengthsOf(const flow::FluidSource& source, const GridProblem& problem);

/// The flow at the end, and the maximum |∇·u|·Δt and CFL number of all steps.
struct SolvedProblem {
    StaggeredFlow end;
    double computingSeconds = 0;  ///< wall-clock time of the steps
    float divergencePerStep = 0, cellsPerStep = 0;
};
[[nodiscard]] SolvedProblem solve(const GridProblem& problem, flow::AdvectionRule rule);

}  // namespace dustbench::grid_fluid::precision
