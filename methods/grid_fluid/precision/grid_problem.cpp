#include "methods/grid_fluid/precision/grid_problem.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

#include "methods/contract/errors.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::precision {
namespace {

constexpr int segments = 64;

/// A = Γ/4π ∮ dl / √(d² + a²)
class Potential {
 public:
    explicit Potential(const VortexRing& ring) : squareOfCore_(ring.coreMetres * ring.coreMetres) {
        for (int s = 0; s < segments; ++s) {
            const double turn = 2 * std::numbers::pi * (s + 0.5) / segments;
            const glm::dvec3 outwards(0, std::cos(turn), std::sin(turn)), along(0, -outwards.z, outwards.y);
            places_[static_cast<std::size_t>(s)] = ring.centreMetres + ring.radiusMetres * outwards;
            // Γ/4π times the length of a segment: Γ·R/(2·segments)
            strengths_[static_cast<std::size_t>(s)] =
                along * (ring.circulationM2PerSecond * ring.radiusMetres / (2 * segments));
        }
    }
    [[nodiscard]] glm::dvec3 at(const glm::dvec3& place) const {
        glm::dvec3 sum(0);
        for (std::size_t s = 0; s < places_.size(); ++s) {
            const glm::dvec3 d = place - places_[s];
            sum += strengths_[s] / std::sqrt(glm::dot(d, d) + squareOfCore_);
        }
        return sum;
    }

 private:
    double squareOfCore_;
    std::array<glm::dvec3, segments> places_{}, strengths_{};
};

constexpr double widthMetres = 3.2;
constexpr float windMetresPerSecond = 6;

/// The properties of a problem that are the same on every grid.
struct Definition {
    glm::ivec3 eighths;  ///< of the width, along each axis
    double seconds;
    int stepsForEight;  ///< on a grid of 8 cells across; in proportion on others
};

Definition definitionOf(ProblemKind kind) {
    switch (kind) {
        case ProblemKind::plume:
            return {{8, 10, 8}, 1.92, 12};
        case ProblemKind::ring:
            return {{8, 8, 8}, 1.2, 15};
        case ProblemKind::car:
            break;
    }
    return {{16, 8, 8}, 0.5, 8};
}

/// Cells whose centres are in a ball.
std::vector<std::uint8_t> ballIn(const flow::FluidBox& box, const glm::dvec3& centreMetres, double radiusMetres) {
    std::vector<std::uint8_t> inside;
    inside.reserve(box.cellCount());
    for (int k = 0; k < box.cells.z; ++k)
        for (int j = 0; j < box.cells.y; ++j)
            for (int i = 0; i < box.cells.x; ++i) {
                const glm::dvec3 d = (glm::dvec3(i, j, k) + 0.5) * box.spacingMetres - centreMetres;
                inside.push_back(glm::dot(d, d) < radiusMetres * radiusMetres ? 1 : 0);
            }
    return inside;
}

void addPlume(GridProblem& problem) {
    flow::FluidSource source;
    source.centreMetres = {1.6, 0.7, 1.6};
    source.radiusMetres = 0.25;
    source.densityPerSecond = 2;
    source.kelvinPerSecond = 80;
    problem.sources = {source};
    // Not directly above the source, so that the flow is not symmetric.
    problem.solids = ballIn(problem.settings.box, {1.7, 1.9, 1.65}, 0.45);
    problem.settings.forces.buoyancyPerKelvin = 0.1f;
}

void addRing(GridProblem& problem) {
    const flow::FluidBox& box = problem.settings.box;
    const VortexRing ring{{0.9, 1.5, 1.65}, 0.6, 0.2, 6};
    addRing(ring, box, problem.begin);
    constexpr double smokeMetres = 0.2;
    for (int k = 0; k < box.cells.z; ++k)
        for (int j = 0; j < box.cells.y; ++j)
            for (int i = 0; i < box.cells.x; ++i) {
                const double d = ring.distanceMetres((glm::dvec3(i, j, k) + 0.5) * box.spacingMetres) / smokeMetres;
                problem.begin.density[problem.begin.cell(i, j, k)] = static_cast<float>(std::exp(-d * d / 2));
            }
}

void addCar(GridProblem& problem, const GridProblem::CarCells& car) {
    using enum flow::Side;
    problem.settings.sides = {inflow, inflow, wall, wall, wall, wall};
    problem.settings.windMetresPerSecond = {-windMetresPerSecond, 0, 0};
    std::ranges::fill(problem.begin.speeds[0], -windMetresPerSecond);
    flow::FluidBox tunnel = problem.settings.box;
    tunnel.originMetres = {-2.2, 0, -1.6};
    problem.solids = car(tunnel);
    flow::FluidSource source;
    source.centreMetres = {5.85, 0.6, 1.7};
    source.radiusMetres = 0.2;
    source.densityPerSecond = 10;
    problem.sources = {source};
}

void giveSolids(flow::FluidSolver& solver, const GridProblem& problem) {
    solver.setSolids({problem.solids, {}});
}

/// Makes the initial flow of a problem divergence-free, by a step so short that nothing else changes.
void project(GridProblem& problem) {
    constexpr double momentSeconds = 1e-7, share = 1e-2;
    flow::FluidSettings settings = problem.settings;
    settings.forces = {.buoyancyPerKelvin = 0};
    settings.divergencePerStep =
        settings.divergencePerStep * static_cast<float>(share * momentSeconds / problem.stepSeconds);
    MemoryLedger ledger;
    flow::FluidSolver solver(settings, ledger);
    giveTo(solver, problem.begin);
    giveSolids(solver, problem);
    (void)solver.step(momentSeconds, {});
    const StaggeredFlow projected = storedBy(solver);
    problem.begin.speeds = projected.speeds;
}

}  // namespace

double VortexRing::distanceMetres(const glm::dvec3& place) const {
    const glm::dvec3 d = place - centreMetres;
    return std::hypot(d.x, std::hypot(d.y, d.z) - radiusMetres);
}

void addRing(const VortexRing& ring, const flow::FluidBox& box, StaggeredFlow& flow) {
    const Potential potential(ring);
    const double h = box.spacingMetres;
    const glm::ivec3 corners = box.cells + 1;
    const auto edgeAt = [&](int axis, const glm::ivec3& corner) {
        glm::dvec3 middle(corner);
        middle[axis] += 0.5;
        return potential.at(box.originMetres + middle * h)[axis];
    };
    // The potential of the edges along y and z from each corner; along x it is 0.
    const auto index = [&](const glm::ivec3& corner) {
        return (static_cast<std::size_t>(corner.z) * static_cast<std::size_t>(corners.y) +
                static_cast<std::size_t>(corner.y)) *
                   static_cast<std::size_t>(corners.x) +
               static_cast<std::size_t>(corner.x);
    };
    std::vector<double> y(index({0, 0, corners.z})), z(y.size());
    parallel::forEachBlock(static_cast<std::size_t>(corners.z), 1, [&](std::size_t slab, std::size_t) {
        for (glm::ivec3 c(0, 0, static_cast<int>(slab)); c.y < corners.y; ++c.y)
            for (c.x = 0; c.x < corners.x; ++c.x) {
                y[index(c)] = edgeAt(1, c);
                z[index(c)] = edgeAt(2, c);
            }
    });
    const glm::ivec3 nextX(1, 0, 0), nextY(0, 1, 0), nextZ(0, 0, 1);
    const auto forFaces = [&](int axis, const auto& circulation) {
        const glm::ivec3 faces = flow.faces(axis);
        for (glm::ivec3 c(0); c.z < faces.z; ++c.z)
            for (c.y = 0; c.y < faces.y; ++c.y)
                for (c.x = 0; c.x < faces.x; ++c.x)
                    flow.speeds[static_cast<std::size_t>(axis)][flow.face(axis, c.x, c.y, c.z)] +=
                        static_cast<float>(circulation(c) / h);
    };
    forFaces(
        0, [&](const glm::ivec3& c) { return z[index(c + nextY)] - z[index(c)] - y[index(c + nextZ)] + y[index(c)]; });
    forFaces(1, [&](const glm::ivec3& c) { return z[index(c)] - z[index(c + nextX)]; });
    forFaces(2, [&](const glm::ivec3& c) { return y[index(c + nextX)] - y[index(c)]; });
}

void checkCells(int cellsAcross) {
    if (cellsAcross < 8 || cellsAcross > 256 || cellsAcross % 8 != 0)
        throw InputError("cells: got " + std::to_string(cellsAcross) +
                         " across the box, allowed: multiples of 8 from 8 to 256");
}

GridProblem problemOn(ProblemKind kind, int cellsAcross, const GridProblem::CarCells& car) {
    checkCells(cellsAcross);
    const Definition definition = definitionOf(kind);
    GridProblem problem;
    problem.settings.box = {definition.eighths * (cellsAcross / 8), widthMetres / cellsAcross, {0, 0, 0}};
    problem.settings.sides = flow::closed;
    problem.settings.forces.buoyancyPerKelvin = 0;
    problem.settings.maximumCycles = 300;  // until the tolerance is met
    problem.steps = definition.stepsForEight * cellsAcross / 8;
    problem.stepSeconds = definition.seconds / problem.steps;
    problem.begin = StaggeredFlow(problem.settings.box.cells);
    switch (kind) {
        case ProblemKind::plume:
            addPlume(problem);
            break;
        case ProblemKind::ring:
            addRing(problem);
            break;
        case ProblemKind::car:
            addCar(problem, car);
            break;
    }
    project(problem);
    return problem;
}

std::vector<float> strengthsOf(const flow::FluidSource& source, const GridProblem& problem) {
    const flow::FluidBox& box = problem.settings.box;
    const flow::SourceReach reach = flow::reachOf(source, box);
    std::vector<float> strengths(box.cellCount());
    for (int k = reach.first.z; k <= reach.last.z; ++k)
        for (int j = reach.first.y; j <= reach.last.y; ++j)
            for (int i = reach.first.x; i <= reach.last.x; ++i) {
                const std::size_t at = problem.begin.cell(i, j, k);
                const glm::vec3 d = (glm::vec3(i, j, k) - glm::vec3(reach.centreCells)) * reach.perRadius;
                if (problem.solids.empty() || problem.solids[at] == 0) strengths[at] = std::exp(-0.5f * glm::dot(d, d));
            }
    return strengths;
}

SolvedProblem solve(const GridProblem& problem, flow::AdvectionRule rule) {
    flow::FluidSettings settings = problem.settings;
    settings.advection = rule;
    MemoryLedger ledger;
    flow::FluidSolver solver(settings, ledger);
    giveTo(solver, problem.begin);
    giveSolids(solver, problem);
    SolvedProblem solved;
    const auto begin = std::chrono::steady_clock::now();
    for (int step = 0; step < problem.steps; ++step) {
        const flow::StepReport report = solver.step(problem.stepSeconds, problem.sources);
        solved.divergencePerStep = std::max(solved.divergencePerStep, report.divergencePerStep);
        solved.cellsPerStep = std::max(solved.cellsPerStep, report.cellsPerStep);
    }
    solved.computingSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    solved.end = storedBy(solver);
    return solved;
}

}  // namespace dustbench::grid_fluid::precision
