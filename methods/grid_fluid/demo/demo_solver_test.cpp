// Compares the demo by OpenGL with the plain one; tests its memory and the properties of its scheme.
#include "methods/grid_fluid/demo/demo_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "methods/grid_fluid/demo/gl_demo_solver.h"

namespace dustbench::grid_fluid::demo {
namespace {

gpu::Device& device() {
    static gpu::Device one;
    return one;
}

/// Smoke that rises past a moving ball.
struct Smoke {
    explicit Smoke(glm::ivec3 cells = {24, 30, 18}) {
        settings.box = {cells, 0.1, {0, 0, 0}};
        settings.reactionLossPerSecond = 0.5f;
        source.centreMetres = {1.2, 0.4, 0.9};
        source.radiusMetres = 0.25;
        source.densityPerSecond = 4;
        source.kelvinPerSecond = 300;
        source.reaction = 1;
        source.velocityMetresPerSecond = {0, 2, 0};
        source.velocityPerSecond = 3;
        for (int k = 0; k < cells.z; ++k)
            for (int j = 0; j < cells.y; ++j)
                for (int i = 0; i < cells.x; ++i)
                    body.push_back(glm::distance(glm::vec3(i, j, k), glm::vec3(12, 14, 9)) < 3.3f ? 1 : 0);
        motion.velocity = {0.5f, 0, 0};
    }
    void run(flow::Solver& solver, int steps) {
        solver.setSolids({body, {&motion, 1}, velocities});
        for (int step = 0; step < steps; ++step) report = solver.step(1.0 / 60, {&source, 1}, StageClock());
    }
    [[nodiscard]] static std::vector<float> valuesOf(const flow::Solver& solver, flow::Lane lane) {
        std::vector<float> values(solver.box().cellCount());
        solver.gather(lane, values);
        return values;
    }
    DemoSettings settings;
    flow::FluidSource source;
    flow::StepReport report;
    std::vector<std::uint8_t> body;
    flow::BodyMotion motion;
    std::vector<glm::vec3> velocities;
    MemoryLedger ledger;
};

TEST(DemoSolver, IsTheSameByOpenGlAsFarAsHalvesAllow) {
    for (const bool burns : {false, true}) {
        Smoke smoke;
        smoke.settings.burns = burns;
        DemoSolver cpu(smoke.settings, smoke.ledger);
        GlDemoSolver gl(smoke.settings, device());
        smoke.run(cpu, 4);
        const flow::StepReport ofCpu = smoke.report;
        smoke.run(gl, 4);
        EXPECT_NEAR(smoke.report.cellsPerStep, ofCpu.cellsPerStep, 2e-3f * ofCpu.cellsPerStep);
        EXPECT_NEAR(smoke.report.divergencePerStep, ofCpu.divergencePerStep, 1e-2f * ofCpu.divergencePerStep);
        for (std::size_t lane = 0; lane < flow::lanes; ++lane) {
            const auto which = static_cast<flow::Lane>(lane);
            const std::vector<float> one = Smoke::valuesOf(cpu, which), other = Smoke::valuesOf(gl, which);
            double square = 0, off = 0;
            for (std::size_t c = 0; c < one.size(); ++c) {
                square += static_cast<double>(one[c]) * static_cast<double>(one[c]);
                off += std::pow(static_cast<double>(one[c] - other[c]), 2);
            }
            EXPECT_GT(square, 0) << lane;
            // OpenGL may round to either neighbouring half, 2^-10 apart: a few of these in four steps of twenty stages.
            EXPECT_LE(std::sqrt(off / square), 5e-3) << lane;
        }
    }
}

TEST(DemoSolver, TakesTheBytesOfThePaperToTheByte) {
    for (const glm::ivec3 cells : {glm::ivec3(24, 30, 18), glm::ivec3(17, 9, 5)}) {
        Smoke smoke(cells);
        const std::size_t count = smoke.settings.box.cellCount();
        const std::size_t before = device().ledger().totalBytes();
        const GlDemoSolver gl(smoke.settings, device());
        const MemoryReport report = gl.gpuMemory();
        EXPECT_EQ(report[0].gpuBytes, 32 * count);
        EXPECT_EQ(report[1].gpuBytes, 9 * count);
        EXPECT_EQ(device().ledger().totalBytes() - before, 41 * count + report[2].gpuBytes);
    }
}

TEST(DemoSolver, LeavesDivergenceThatSixSweepsDoNotRemove) {
    Smoke smoke;
    DemoSolver solver(smoke.settings, smoke.ledger);
    smoke.run(solver, 10);
    EXPECT_GT(solver.divergencePerStep(), 1e-3f);
    EXPECT_EQ(smoke.report.pressure.cycles, 6);
    for (const float value : Smoke::valuesOf(solver, flow::density)) EXPECT_GE(value, 0);
    // Solid cells have the solid's speed and no smoke.
    const std::vector<float> speed = Smoke::valuesOf(solver, flow::velocityX);
    const std::vector<float> density = Smoke::valuesOf(solver, flow::density);
    for (std::size_t c = 0; c < smoke.body.size(); ++c)
        if (smoke.body[c] != 0) {
            EXPECT_EQ(speed[c], 0.5f);
            EXPECT_EQ(density[c], 0);
        }
}

TEST(DemoSolver, HoldsTheVelocitiesOfASolidThatDeforms) {
    Smoke smoke;
    smoke.motion.byCell = true;
    for (std::size_t c = 0; c < smoke.body.size(); ++c)
        smoke.velocities.emplace_back(0.25f * static_cast<float>(c % 7), -0.5f, 0.125f * static_cast<float>(c % 5));
    DemoSolver cpu(smoke.settings, smoke.ledger);
    GlDemoSolver gl(smoke.settings, device());
    for (flow::Solver* solver : {static_cast<flow::Solver*>(&cpu), static_cast<flow::Solver*>(&gl)}) {
        smoke.run(*solver, 2);
        const std::vector<float> x = Smoke::valuesOf(*solver, flow::velocityX);
        const std::vector<float> z = Smoke::valuesOf(*solver, flow::velocityZ);
        for (std::size_t c = 0; c < smoke.body.size(); ++c)
            if (smoke.body[c] != 0) {
                EXPECT_EQ(x[c], smoke.velocities[c].x);
                EXPECT_EQ(z[c], smoke.velocities[c].z);
            }
    }
}

TEST(DemoSolver, DensityFadesByItsShareAStepWhereNothingFlows) {
    Smoke smoke;
    smoke.settings.buoyancyPerKelvin = 0;
    smoke.source.velocityPerSecond = smoke.source.kelvinPerSecond = 0;
    smoke.motion = {};
    const auto fades = [&](flow::Solver& solver) {
        const auto sum = [&] {
            double total = 0;
            for (const float value : Smoke::valuesOf(solver, flow::density)) total += static_cast<double>(value);
            return total;
        };
        smoke.source.densityPerSecond = 4;
        smoke.run(solver, 1);
        smoke.source.densityPerSecond = 0;
        const double before = sum();
        smoke.run(solver, 20);
        return sum() / before;
    };
    DemoSolver cpu(smoke.settings, smoke.ledger);
    GlDemoSolver gl(smoke.settings, device());
    // 1 - 0.9995 is between half a step and one step of half precision, so that up to twice as much is lost.
    for (flow::Solver* solver : {static_cast<flow::Solver*>(&cpu), static_cast<flow::Solver*>(&gl)}) {
        const double kept = fades(*solver);
        EXPECT_LE(kept, std::pow(0.9995, 20) + 1e-4);
        EXPECT_GE(kept, std::pow(0.9995, 40));
    }
}

}  // namespace
}  // namespace dustbench::grid_fluid::demo
