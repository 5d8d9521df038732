#include "methods/grid_fluid/obstacles_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>

#include "methods/grid_fluid/flow/fluid_solver.h"

namespace dustbench::grid_fluid::obstacles {
namespace {

using flow::CellLayout;

constexpr glm::ivec3 cells{56, 32, 32};
constexpr double edge = 0.1;
constexpr glm::vec3 stream{1, 0, 0};
constexpr double stepSeconds = 1.0 / 30;
constexpr int steps = 30;
constexpr double radius = 0.7;

flow::FluidSettings settingsOf(const ObstacleSettings& settings) {
    flow::FluidSettings solver;
    solver.box = {cells, edge, {0, 0, 0}};
    solver.windMetresPerSecond = stream;
    solver.sides = flow::withWind(flow::openOverFloor, stream);
    solver.pressure = settings.pressure;
    solver.jacobiSweeps = settings.jacobiSweeps;
    return solver;
}

/// 1 in the cells whose centres lie in the ball.
std::vector<std::uint8_t> ballAt(const glm::dvec3& centre, double ballRadius) {
    std::vector<std::uint8_t> inside;
    for (int k = 0; k < cells.z; ++k)
        for (int j = 0; j < cells.y; ++j)
            for (int i = 0; i < cells.x; ++i) {
                const glm::dvec3 away = (glm::dvec3(i, j, k) + 0.5) * edge - centre;
                inside.push_back(glm::dot(away, away) < ballRadius * ballRadius ? 1 : 0);
            }
    return inside;
}

/// Returns the share that is swallowed of what the undisturbed stream, relative to the ball, carries into the cells up
/// to two edges from the ball.
double shareSwallowed(const flow::FluidSolver& solver, const glm::dvec3& centre, const glm::vec3& ballVelocity) {
    const std::vector<std::uint8_t> near = ballAt(centre, radius + 2 * edge);
    const auto isNear = [&](const glm::ivec3& cell) {
        return near[static_cast<std::size_t>(cell.x + cells.x * (cell.y + cells.y * cell.z))] != 0;
    };
    const auto faceSpeed = [&](const glm::ivec3& cell, int axis) {
        return static_cast<double>(solver.cells().cell(solver.layout().at(cell.x, cell.y, cell.z))[axis]);
    };
    double swallowed = 0, undisturbed = 0;
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 next(0);
        next[axis] = 1;
        for (int k = 0; k + next.z < cells.z; ++k)
            for (int j = 0; j + next.y < cells.y; ++j)
                for (int i = 0; i + next.x < cells.x; ++i) {
                    const glm::ivec3 one(i, j, k), other = one + next;
                    if (isNear(one) == isNear(other)) continue;
                    const double inwards = isNear(other) ? 1 : -1;
                    swallowed += inwards * faceSpeed(other, axis);
                    undisturbed += std::max(inwards * static_cast<double>(stream[axis] - ballVelocity[axis]), 0.0);
                }
    }
    return std::abs(swallowed) / undisturbed;
}

double smokeInside(const flow::FluidSolver& solver, const std::vector<std::uint8_t>& inside) {
    double within = 0, around = 0;
    std::size_t cell = 0;
    for (int k = 0; k < cells.z; ++k)
        for (int j = 0; j < cells.y; ++j)
            for (int i = 0; i < cells.x; ++i) {
                const auto density =
                    static_cast<double>(solver.cells().cell(solver.layout().at(i, j, k))[flow::density]);
                double& maximum = inside[cell++] != 0 ? within : around;
                maximum = std::max(maximum, density);
            }
    return around > 0 ? within / around : 0;
}

}  // namespace

ObstacleReport measureObstacleLeakage(const ObstacleSettings& settings) {
    MemoryLedger ledger;
    flow::FluidSolver solver(settingsOf(settings), ledger);
    flow::FluidSource smoke;
    smoke.centreMetres = {1.6, 1.6, 1.6};
    smoke.radiusMetres = 0.4;
    smoke.densityPerSecond = 4;
    flow::BodyMotion motion;
    motion.velocity = -settings.ballMetresPerSecond * stream;
    ObstacleReport report;
    for (int step = 0; step < steps; ++step) {
        const glm::dvec3 centre = glm::dvec3(3.2, 1.6, 1.6) + glm::dvec3(motion.velocity) * (stepSeconds * step);
        const std::vector<std::uint8_t> inside = ballAt(centre, radius);
        if (settings.isSolid) solver.setSolids({inside, {&motion, 1}});
        solver.step(stepSeconds, {&smoke, 1});
        report.smokeInside = std::max(report.smokeInside, smokeInside(solver, inside));
        report.swallowed = std::max(report.swallowed, shareSwallowed(solver, centre, motion.velocity));
    }
    return report;
}

namespace {

std::vector<Finding> measureLeakages() {
    std::vector<Finding> findings;
    double inside = 0;
    for (const auto& [name, method] :
         {std::pair{"multigrid", flow::PressureMethod::multigrid}, {"jacobi", flow::PressureMethod::jacobi}})
        for (const auto& [state, speed] : {std::pair{"rest", 0.0f}, {"moving", 0.5f}}) {
            ObstacleSettings settings;
            settings.pressure = method;
            settings.ballMetresPerSecond = speed;
            const ObstacleReport report = measureObstacleLeakage(settings);
            findings.push_back({fmt::format("swallowed_{}_{}", state, name), report.swallowed, report.swallowed,
                                report.swallowed, steps});
            inside = std::max(inside, report.smokeInside);
        }
    findings.push_back({"smoke_inside", inside, inside, inside, 4 * steps});
    return findings;
}

}  // namespace

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "How much of a stream an obstacle swallows, and what of its smoke gets inside.";
    info.source = "Senger2009";
    info.run = [](ExperimentContext&) { return measureLeakages(); };
    return info;
}

}  // namespace dustbench::grid_fluid::obstacles
