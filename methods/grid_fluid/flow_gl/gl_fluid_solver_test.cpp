// Compares the GPU solver with the CPU solver and with itself. Over 400 lines: all tests share the worlds that both
// solve.
#include "methods/grid_fluid/flow_gl/gl_fluid_solver.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "methods/grid_fluid/flow/fluid_solver.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using flow::CellField;
using flow::CellLayout;

gpu::Device& device() {
    static gpu::Device one;
    return one;
}

/// A box with a source, random flow and a ball that moves and rotates, for either solver.
struct Flow {
    explicit Flow(glm::ivec3 cells = {24, 20, 16}) {
        settings.box = {cells, 0.1, {0, 0, 0}};
        settings.forces.buoyancyPerKelvin = 0.5f;
        settings.forces.weightPerDensity = 0.1f;
        settings.divergencePerStep = 3e-6f;  // tight, because the remaining divergence differs between the solvers
        flow::FluidSource source;
        source.centreMetres = {0.71, 0.33, 0.92};
        source.radiusMetres = 0.2;
        source.densityPerSecond = 4;
        source.kelvinPerSecond = 40;
        source.reaction = 1;
        source.velocityMetresPerSecond = {1, 2, 0};
        source.velocityPerSecond = 3;
        sources = {source, source};
        sources[1].centreMetres.x = 1.5;
        sources[1].densityPerSecond = 0;
        sources[1].amountM3PerSecond = 0.2f;
    }
    /// Returns a smooth random state: velocities up to `speed`, other values between 0 and 1.
    [[nodiscard]] CellField randomState(MemoryLedger& ledger, float speed) const {
        const CellLayout layout(settings.box.cells);
        CellField state(layout, ledger.account("state"));
        std::mt19937 random(11);
        std::uniform_real_distribution<float> value(-1, 1);
        std::array<std::array<float, 4>, flow::lanes> waves;
        for (auto& wave : waves)
            for (float& number : wave) number = value(random);
        for (int k = 0; k < layout.nz; ++k)
            for (int j = 0; j < layout.ny; ++j)
                for (int i = 0; i < layout.nx; ++i)
                    for (std::size_t lane = 0; lane < flow::lanes; ++lane) {
                        const auto& w = waves[lane];
                        const float wave =
                            std::sin(0.7f * (w[0] * static_cast<float>(i) + w[1] * static_cast<float>(j) +
                                             w[2] * static_cast<float>(k)) +
                                     6 * w[3]) +
                            0.1f * value(random);
                        state.cell(layout.at(i, j, k))[lane] = lane < 3 ? speed * wave : std::max(0.0f, 0.5f * wave);
                    }
        return state;
    }
    [[nodiscard]] flow::SolidMask ball(float x) {
        const glm::vec3 centre(x, 9.3f, 7.8f);
        body.clear();
        for (int k = 0; k < settings.box.cells.z; ++k)
            for (int j = 0; j < settings.box.cells.y; ++j)
                for (int i = 0; i < settings.box.cells.x; ++i)
                    body.push_back(glm::distance(glm::vec3(i, j, k) + 0.5f, centre) < 3.2f ? 2 : 0);
        motions = {{}, {{0.5f, 0, 0}, {0, 0.2f, 0}, centre}};
        motions[1].byCell = deforms;
        velocities.clear();
        for (std::size_t c = 0; deforms && c < body.size(); ++c) {
            const auto phase = static_cast<float>(c % 97);
            velocities.emplace_back(0.3f * std::sin(phase), 0.2f * std::cos(2 * phase), 0.1f * std::sin(3 * phase));
        }
        return {body, motions, velocities};
    }

    flow::FluidSettings settings;
    std::vector<flow::FluidSource> sources;
    std::vector<std::uint8_t> body;
    std::vector<flow::BodyMotion> motions;
    bool deforms = false;
    std::vector<glm::vec3> velocities;
    glm::ivec3 scrollBeforeEachStep{0};
};

template <typename Cell>
void forCells(const CellLayout& layout, const Cell& cell) {
    for (int k = 0; k < layout.nz; ++k)
        for (int j = 0; j < layout.ny; ++j)
            for (int i = 0; i < layout.nx; ++i) cell(i, j, k, layout.at(i, j, k));
}

/// The maximum difference of each value in the cells, relative to the maximum value of its kind; velocities together.
struct Difference {
    double velocity = 0, density = 0, temperature = 0, reaction = 0, mean = 0;
};

Difference between(const CellField& one, const CellField& other, const CellLayout& layout) {
    std::array<double, flow::lanes> maximum{}, off{};
    Difference result;
    double sum = 0;
    forCells(layout, [&](int, int, int, std::size_t at) {
        for (std::size_t lane = 0; lane < flow::lanes; ++lane) {
            const auto a = static_cast<double>(one.cell(at)[lane]), b = static_cast<double>(other.cell(at)[lane]);
            const std::size_t kind = lane < 3 ? 0 : lane;
            maximum[kind] = std::max(maximum[kind], std::fabs(a));
            off[kind] = std::max(off[kind], std::fabs(a - b));
            if (lane == flow::density) sum += std::fabs(a - b);
        }
    });
    const auto share = [&](std::size_t kind) { return maximum[kind] > 0 ? off[kind] / maximum[kind] : off[kind]; };
    result.velocity = share(0);
    result.density = share(flow::density);
    result.temperature = share(flow::temperature);
    result.reaction = share(flow::reaction);
    result.mean = sum / maximum[flow::density] / static_cast<double>(layout.rows()) / layout.nx;
    return result;
}

/// The same steps with both solvers.
struct Pair {
    Pair(Flow& flow, bool withBall, int steps = 3) {
        flow::FluidSolver cpu(flow.settings, ledger);
        GlFluidSolver gl(flow.settings, device(), ledger);
        const CellField initial = flow.randomState(ledger, 2);
        cpu.changeCells() = initial;
        gl.writeCells(initial);
        for (int step = 0; step < steps; ++step) {
            if (flow.scrollBeforeEachStep != glm::ivec3(0))
                for (flow::Solver* solver : {static_cast<flow::Solver*>(&cpu), static_cast<flow::Solver*>(&gl)})
                    solver->scroll(flow.scrollBeforeEachStep);
            if (withBall) {
                const flow::SolidMask mask = flow.ball(9.1f + 0.4f * static_cast<float>(step));
                cpu.setSolids(mask);
                gl.setSolids(mask);
            }
            onCpu = cpu.step(0.03, flow.sources);
            onGpu = gl.step(0.03, flow.sources);
        }
        CellField result(cpu.layout(), ledger.account("result"));
        gl.readCells(result);
        difference = between(cpu.cells(), result, cpu.layout());
        const std::vector<float> ofCpu = cpu.pressuresM2PerS2(), ofGl = gl.pressuresM2PerS2();
        EXPECT_EQ(ofCpu.size(), ofGl.size());
        double maximum = 0;
        for (std::size_t cell = 0; cell < ofCpu.size(); ++cell) {
            const auto p = static_cast<double>(ofCpu[cell]);
            pressure = std::max(pressure, std::fabs(p - static_cast<double>(ofGl[cell])));
            maximum = std::max(maximum, std::fabs(p));
        }
        pressure /= maximum;
    }
    void expectTheSame() const {
        EXPECT_LE(difference.velocity, 1e-5);
        EXPECT_LE(difference.density, 1e-5);
        EXPECT_LE(difference.temperature, 1e-5);
        EXPECT_LE(difference.reaction, 1e-5);
        EXPECT_LE(pressure, 3e-4);
        EXPECT_NEAR(onGpu.cellsPerStep, onCpu.cellsPerStep, 1e-4);
        EXPECT_NEAR(onGpu.pressure.unremovable, onCpu.pressure.unremovable, 1e-5);
    }
    MemoryLedger ledger;
    flow::StepReport onCpu, onGpu;
    Difference difference;
    double pressure = 0;
};

TEST(GlFluidSolver, StepsAsTheCpuDoesOverAFloor) {
    Flow flow;
    flow.settings.advection.scheme = flow::AdvectionScheme::semiLagrangian;
    const Pair pair(flow, false);
    pair.expectTheSame();
    EXPECT_LE(pair.onGpu.divergencePerStep, 1e-5f);
}

TEST(GlFluidSolver, StepsAsTheCpuDoesWithWindAllForcesAndARoughBall) {
    Flow flow;
    flow.settings.windMetresPerSecond = {2, 0, -1};
    flow.settings.sides = flow::withWind(flow::openOverFloor, flow.settings.windMetresPerSecond);
    flow.settings.noSlip = true;
    flow.settings.advection.limit = flow::Limit::clamp;
    flow.settings.forces = {.buoyancyPerKelvin = 0.5f,
                            .weightPerDensity = 0.2f,
                            .confinementPerSecond = 2,
                            .densityDecayPerSecond = 0.5f,
                            .coolingPerSecond = 1,
                            .reactionLossPerSecond = 0.7f,
                            .viscosityM2PerSecond = 0.1f};
    const Pair pair(flow, true);
    pair.expectTheSame();
    EXPECT_LE(pair.onGpu.divergencePerStep, 1e-5f);
}

TEST(GlFluidSolver, StepsAsTheCpuDoesWithTheDensityKeptAndASmoothBall) {
    Flow flow;
    flow.settings.keepsDensity = true;
    flow.settings.advection.limit = flow::Limit::revert;
    const Pair pair(flow, true);
    // If a corrected value is close to its limit, the solvers may choose differently: in few cells, by little.
    EXPECT_LE(pair.difference.mean, 1e-6);
    EXPECT_LE(pair.difference.density, 0.05);
    EXPECT_LE(pair.difference.velocity, 0.05);
    EXPECT_LE(pair.onGpu.divergencePerStep, 1e-5f);
}

TEST(GlFluidSolver, StepsAsTheCpuDoesInAClosedBoxOfOddSize) {
    Flow flow({23, 19, 17});
    flow.settings.sides = flow::closed;
    flow.settings.advection.limit = flow::Limit::none;
    const Pair pair(flow, true);
    pair.expectTheSame();
    EXPECT_GT(pair.onGpu.pressure.unremovable, 0);  // a ball that occupies new cells acts as a piston at times
    EXPECT_LE(pair.onGpu.divergencePerStep, 2e-5f);
}

TEST(GlFluidSolver, StepsAsTheCpuDoesAlongTheVelocityOfTheMiddleOfTheStep) {
    for (const auto scheme : {flow::AdvectionScheme::semiLagrangian, flow::AdvectionScheme::macCormack})
        for (const glm::ivec3 scroll : {glm::ivec3(0), glm::ivec3(2, 0, -1)}) {
            Flow flow;
            flow.settings.advection = {scheme, flow::Limit::none, flow::VelocityAt::middle};
            flow.settings.windMetresPerSecond = {2, 0, -1};
            flow.settings.sides = flow::withWind(flow::openOverFloor, flow.settings.windMetresPerSecond);
            flow.scrollBeforeEachStep = scroll;
            const Pair pair(flow, true, 4);
            pair.expectTheSame();
        }
}

TEST(GlFluidSolver, StepsAsTheCpuDoesAroundABallThatDeforms) {
    Flow flow;
    flow.settings.advection.scheme = flow::AdvectionScheme::semiLagrangian;
    flow.deforms = true;
    const Pair pair(flow, true);
    pair.expectTheSame();
    EXPECT_LE(pair.onGpu.divergencePerStep, 1e-5f);
}

TEST(GlFluidSolver, SweepsAsTheCpuDoes) {
    Flow flow;
    flow.settings.pressure = flow::PressureMethod::jacobi;
    flow.settings.jacobiSweeps = 21;
    const Pair pair(flow, true, 2);
    pair.expectTheSame();
    EXPECT_EQ(pair.onGpu.pressure.cycles, 21);
    EXPECT_NEAR(pair.onGpu.pressure.residual, pair.onCpu.pressure.residual, 1e-4f * pair.onCpu.pressure.residual);
}

TEST(GlFluidSolver, PathsReachAsFarAsASolidIsFastThatTheAirIsNot) {
    // The same step, with the maximum speeds searched in the whole state.
    const auto stateAfter = [](bool searched) {
        Flow flow;
        MemoryLedger ledger;
        GlFluidSolver solver(flow.settings, device(), ledger);
        for (int step = 0; step < 3; ++step) solver.step(0.03, flow.sources);
        flow::SolidMask mask = flow.ball(9.1f);
        flow.motions[1].velocity = {0, 0, -30};
        solver.setSolids(mask);
        if (searched) {
            CellField state(solver.layout(), ledger.account("state"));
            solver.readCells(state);
            solver.writeCells(state);
        }
        solver.step(0.03, flow.sources);
        return solver.stateHash();
    };
    EXPECT_EQ(stateAfter(false), stateAfter(true));
}

TEST(GlFluidSolver, HandsOverWhatItStoresAndItsMeans) {
    Flow flow;
    MemoryLedger ledger;
    flow::FluidSolver cpu(flow.settings, ledger);
    GlFluidSolver gl(flow.settings, device(), ledger);
    const CellField initial = flow.randomState(ledger, 2);
    cpu.changeCells() = initial;
    gl.writeCells(initial);
    EXPECT_EQ(gl.divergencePerStep(), 0);  // before the first step
    cpu.step(0.03, flow.sources);
    gl.step(0.03, flow.sources);
    EXPECT_NEAR(gl.divergencePerStep(), cpu.divergencePerStep(), 3e-6f);
    EXPECT_GT(gl.divergencePerStep(), 0);
    EXPECT_LE(gl.divergencePerStep(), 4e-6f);
    std::vector<float> ofCpu(flow.settings.box.cellCount()), ofGl(ofCpu.size());
    for (std::size_t lane = 0; lane < flow::lanes; ++lane)
        for (const bool asStored : {false, true}) {
            const auto which = static_cast<flow::Lane>(lane);
            asStored ? cpu.gatherStored(which, ofCpu) : cpu.gather(which, ofCpu);
            asStored ? gl.gatherStored(which, ofGl) : gl.gather(which, ofGl);
            float maximum = 0, off = 0;
            for (std::size_t cell = 0; cell < ofCpu.size(); ++cell) {
                maximum = std::max(maximum, std::fabs(ofCpu[cell]));
                off = std::max(off, std::fabs(ofCpu[cell] - ofGl[cell]));
            }
            EXPECT_LE(off, 3e-5f * maximum) << lane << asStored;
        }
}

TEST(GlFluidSolver, GivesAndTakesDensityAsTheCpuDoes) {
    Flow flow({23, 19, 17});
    flow.settings.notesLeaving = flow.settings.keepsDensity = true;
    MemoryLedger ledger;
    flow::FluidSolver cpu(flow.settings, ledger);
    GlFluidSolver gl(flow.settings, device(), ledger);
    const CellField initial = flow.randomState(ledger, 2);
    cpu.changeCells() = initial;
    gl.writeCells(initial);
    const std::vector<flow::AddedDensity> added{{{0, 0, 0}, 0.5f}, {{22, 18, 16}, 2}, {{9, 9, 8}, 1}};
    const auto both = [&](const auto& act) {
        act(static_cast<flow::Solver&>(cpu));
        act(static_cast<flow::Solver&>(gl));
    };
    both([&](flow::Solver& solver) { solver.addDensity(added); });
    std::vector<float> ofCpu(flow.settings.box.cellCount()), ofGl(ofCpu.size());
    cpu.gather(flow::density, ofCpu);
    gl.gather(flow::density, ofGl);
    EXPECT_EQ(ofCpu, ofGl);
    // Density covered by solids is given to the rest, also if the same solids cover density that was added.
    const flow::SolidMask mask = flow.ball(9.1f);
    both([&](flow::Solver& solver) { solver.setSolids(mask); });
    both([&](flow::Solver& solver) { solver.addDensity(std::vector<flow::AddedDensity>{{{9, 9, 8}, 40}}); });
    both([&](flow::Solver& solver) { solver.setSolids(mask); });
    both([&](flow::Solver& solver) { solver.step(0.03, {}, StageClock()); });
    ASSERT_EQ(gl.leaving().size(), cpu.leaving().size());
    EXPECT_GT(cpu.leaving().size(), 100u);
    for (std::size_t n = 0; n < cpu.leaving().size(); ++n) {
        const flow::LeavingDensity &a = cpu.leaving()[n], &b = gl.leaving()[n];
        EXPECT_TRUE(a.cell == b.cell && a.axis == b.axis && a.far == b.far) << n;
        EXPECT_NEAR(a.cells, b.cells, 1e-5);
        EXPECT_NEAR(a.density, b.density, 1e-5);
    }
    const auto totalOf = [&](const flow::Solver& solver) {
        solver.gather(flow::density, ofCpu);
        return std::accumulate(ofCpu.begin(), ofCpu.end(), 0.0);
    };
    EXPECT_NEAR(totalOf(gl), totalOf(cpu), 1e-4 * totalOf(cpu));
}

TEST(GlFluidSolver, ConvergesAroundRandomSolids) {
    for (const double share : {0.05, 0.3}) {
        Flow flow;
        flow.settings.divergencePerStep = 1e-4f;
        MemoryLedger ledger;
        GlFluidSolver gl(flow.settings, device(), ledger);
        std::mt19937 random(3);
        std::bernoulli_distribution chance(share);
        for (std::size_t c = 0; c < flow.settings.box.cellCount(); ++c) flow.body.push_back(chance(random) ? 1 : 0);
        gl.setSolids({flow.body, {}});
        for (int step = 0; step < 2; ++step) {
            const flow::StepReport report = gl.step(0.03, flow.sources);
            EXPECT_LE(report.divergencePerStep, 1e-4f) << share;
            EXPECT_LE(report.pressure.cycles, 12) << share;
        }
    }
}

TEST(GlFluidSolver, IsTheSameAgainAndScrollsByWholeCells) {
    Flow flow;
    MemoryLedger ledger;
    const auto run = [&](GlFluidSolver& gl) {
        for (int step = 0; step < 4; ++step) gl.step(0.03, flow.sources);
    };
    GlFluidSolver one(flow.settings, device(), ledger), other(flow.settings, device(), ledger);
    run(one);
    run(other);
    EXPECT_EQ(one.stateHash(), other.stateHash());
    EXPECT_EQ(one.steps(), 4);

    CellField before(one.layout(), ledger.account("before")), after(one.layout(), ledger.account("after"));
    one.readCells(before);
    one.scroll({3, 0, -2});
    one.readCells(after);
    EXPECT_NEAR(one.box().originMetres.x, 0.3, 1e-12);
    EXPECT_NEAR(one.box().originMetres.z, -0.2, 1e-12);
    forCells(one.layout(), [&](int i, int j, int k, std::size_t at) {
        for (std::size_t lane = 0; lane < flow::lanes; ++lane) {
            const bool had = i + 3 < (lane == flow::velocityX ? 25 : 24) && k - 2 >= 0;  // the far side's faces too
            EXPECT_EQ(after.cell(at)[lane], had ? before.cell(one.layout().at(i + 3, j, k - 2))[lane] : 0.0f);
        }
    });
    EXPECT_EQ(one.pressuresM2PerS2(), std::vector<float>(24 * 20 * 16, 0.0f));
    one.step(0.03, flow.sources);
}

TEST(GlFluidSolver, RefusesBadInputInOneLine) {
    Flow flow({8, 8, 8});
    MemoryLedger ledger;
    const auto refusal = [&](const auto& change) {
        flow::FluidSettings settings = flow.settings;
        change(settings);
        return inputError([&] { const GlFluidSolver solver(settings, device(), ledger); });
    };
    EXPECT_NE(refusal([](flow::FluidSettings& s) { s.box.spacingMetres = 0; }).find("spacing: got 0.0"),
              std::string::npos);
    const std::string large = refusal([](flow::FluidSettings& s) { s.box.cells = {4096, 4096, 4096}; });
    EXPECT_NE(large.find("4096x4096x4096 cells, 1101123027072 bytes in one buffer of OpenGL"), std::string::npos)
        << large;

    GlFluidSolver solver(flow.settings, device(), ledger);
    const std::vector<std::uint8_t> full(512, 1);
    EXPECT_NE(inputError([&] { solver.setSolids({full, {}}); }).find("the whole box is solid"), std::string::npos);
    EXPECT_NE(inputError([&] { solver.step(-1, {}); }).find("step"), std::string::npos);
    const std::vector<std::uint8_t> one = [] {
        std::vector<std::uint8_t> some(512, 0);
        some[9] = 1;
        return some;
    }();
    const flow::BodyMotion deforming{.byCell = true};
    EXPECT_NE(inputError([&] {
                  solver.setSolids({one, {&deforming, 1}});
              }).find("got the velocities of 0 cells for solid 1, which deforms, allowed: 512"),
              std::string::npos);
    flow.sources[0].radiusMetres = 0;
    EXPECT_NE(inputError([&] { solver.step(0.1, flow.sources); }).find("radius"), std::string::npos);
}

TEST(GlFluidSolver, StopsWhereANumberIsLost) {
    Flow flow({8, 8, 8});
    flow.settings.forces.buoyancyPerKelvin = 100;
    MemoryLedger ledger;
    GlFluidSolver solver(flow.settings, device(), ledger);
    solver.step(0.1, {});
    const auto lost = [&] {
        try {
            solver.step(0.1, {});
        } catch (const std::runtime_error& error) {
            return std::string(error.what());
        }
        return std::string("nothing");
    };
    CellField state(solver.layout(), ledger.account("state"));
    solver.readCells(state);
    state.cell(solver.layout().at(3, 2, 5))[flow::temperature] = std::numeric_limits<float>::quiet_NaN();
    solver.writeCells(state);
    EXPECT_EQ(lost(), "fluid: after step 1 the temperature of cell 3, 2, 5 is not a number");

    // A value that overflows within the step.
    state.cell(solver.layout().at(3, 2, 5))[flow::temperature] = 3e38f;
    solver.writeCells(state);
    EXPECT_EQ(lost().substr(0, 25), "fluid: after step 2 the v");
}

}  // namespace
}  // namespace dustbench::grid_fluid::flow_gl
