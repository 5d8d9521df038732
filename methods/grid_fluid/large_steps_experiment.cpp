#include "methods/grid_fluid/large_steps_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/grid_fluid/flow/fluid_solver.h"

namespace dustbench::grid_fluid::large_steps {
namespace {

constexpr glm::ivec3 cells{32, 64, 32};
constexpr double edge = 0.1;
constexpr double cellsCrossed = 80;
constexpr double jetStepSeconds = 1.0 / 120;
constexpr int jetSteps = 40;

flow::FluidSource jet() {
    flow::FluidSource source;
    source.centreMetres = {1.6, 1.0, 1.6};
    source.radiusMetres = 0.3;
    source.velocityMetresPerSecond = {0, 3, 0};
    source.velocityPerSecond = 30;
    return source;
}

/// State of the stored faces; energy in m⁵/s², divided by the density.
struct Motion {
    double speed = 0, energy = 0;
    double height = 0;  ///< of the energy's centre
};

Motion motionOf(const flow::Solver& solver) {
    Motion motion;
    std::vector<float> speeds(solver.box().cellCount());
    double moment = 0;
    for (const flow::Lane axis : {flow::velocityX, flow::velocityY, flow::velocityZ}) {
        solver.gatherStored(axis, speeds);
        for (std::size_t at = 0; at < speeds.size(); ++at) {
            const auto speed = static_cast<double>(speeds[at]);
            const std::size_t row = at / static_cast<std::size_t>(cells.x) % static_cast<std::size_t>(cells.y);
            const double energy = speed * speed / 2 * edge * edge * edge;
            motion.speed = std::max(motion.speed, std::abs(speed));
            motion.energy += energy;
            moment += energy * (static_cast<double>(row) + 0.5) * edge;
        }
    }
    motion.height = moment / motion.energy;
    return motion;
}

}  // namespace

StepReport measureSteps(const StepSettings& settings) {
    flow::FluidSettings fluid;
    fluid.box = {cells, edge, {0, 0, 0}};
    fluid.sides = flow::closed;
    fluid.advection = settings.advection;
    MemoryLedger ledger;
    flow::FluidSolver solver(fluid, ledger);
    const flow::FluidSource source = jet();
    for (int step = 0; step < jetSteps; ++step) solver.step(jetStepSeconds, {&source, 1});

    const Motion begin = motionOf(solver);
    const double stepSeconds = settings.cellsPerStep * edge / begin.speed;
    const auto steps = static_cast<int>(std::lround(cellsCrossed / settings.cellsPerStep));
    StepReport report;
    Motion now = begin;
    for (int step = 0; step < steps && report.lost.empty(); ++step) {
        try {
            if (!settings.isFrozen) solver.step(stepSeconds, {});
        } catch (const SimulationError& error) {
            report.lost = error.what();
        }
        now = motionOf(solver);
        report.speed = std::max(report.speed, now.speed / begin.speed);
        report.energy = std::max(report.energy, now.energy / begin.energy);
    }
    report.energyLeft = now.energy / begin.energy;
    report.travelMetres = now.height - begin.height;
    if (!report.lost.empty()) report.speed = report.energy = std::numeric_limits<double>::infinity();
    return report;
}

namespace {

std::vector<Finding> measureAll() {
    std::vector<Finding> findings;
    const auto found = [&](const std::string& quantity, double value, const StepReport& report, double cellsPerStep) {
        const auto samples = static_cast<std::int64_t>(std::lround(cellsCrossed / cellsPerStep));
        findings.push_back({quantity, value, value, value, samples, report.lost});
    };
    double reference = 0;
    for (const double cellsPerStep : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
        StepSettings settings;
        settings.cellsPerStep = cellsPerStep;
        const StepReport report = measureSteps(settings);
        if (reference == 0) reference = report.travelMetres;
        for (const auto& [name, value] : {std::pair{"speed", report.speed},
                                          {"energy", report.energy},
                                          {"energy_left", report.energyLeft},
                                          {"travel", report.travelMetres / reference}})
            found(fmt::format("{}_{}", name, cellsPerStep), value, report, cellsPerStep);
    }
    StepSettings settings;
    settings.cellsPerStep = 20;
    settings.advection.scheme = flow::AdvectionScheme::macCormack;
    const StepReport unlimited = measureSteps(settings);
    found("speed_unlimited", unlimited.speed, unlimited, 20);
    found("energy_unlimited", unlimited.energy, unlimited, 20);
    settings.isFrozen = true;
    const StepReport frozen = measureSteps(settings);
    found("travel_frozen", frozen.travelMetres / reference, frozen, 20);
    return findings;
}

}  // namespace

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Tests whether a flow stays bounded, and keeps moving, in steps of up to 20 cells.";
    info.source = "Senger2009";
    info.run = [](ExperimentContext&) { return measureAll(); };
    return info;
}

}  // namespace dustbench::grid_fluid::large_steps
