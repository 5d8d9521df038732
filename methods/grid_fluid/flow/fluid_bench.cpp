// Benchmarks a smoke step of 128×64×64 cells past a sphere, as a whole (also in a box of eight times the cells) and by
// kernel, with the memory bandwidth for comparison.
//
// Spacing and time step are 1, so that speeds are in cells per step and the maximum divergence is comparable with that
// of other solvers. `GB/s` is the minimum memory traffic of a kernel divided by its time; compare it with Triad of the
// same run.
#include <benchmark/benchmark.h>

#include <cmath>
#include <optional>
#include <vector>

#include "methods/grid_fluid/flow/fluid_solver.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

/// A plume that has risen past a sphere.
class Plume {
 public:
    Plume(glm::ivec3 cells, bool withSphere, bool moving = false, VelocityAt velocityAt = VelocityAt::begin)
        : cells_(cells), moving_(moving) {
        settings.advection.velocityAt = velocityAt;
        settings.box = {cells, 1.0, {0, 0, 0}};
        settings.forces.buoyancyPerKelvin = 0.01f;
        settings.forces.confinementPerSecond = 0.05f;
        settings.forces.densityDecayPerSecond = 0.001f;
        FluidSource source;
        source.centreMetres = {cells.x * 0.5, cells.y * 0.1, cells.z * 0.5};
        source.radiusMetres = cells.y * 0.06;
        source.densityPerSecond = 0.3f;
        source.kelvinPerSecond = 1;
        sources = {source};
        solver.emplace(settings, ledger);
        if (withSphere) {
            inside.resize(settings.box.cellCount());
            setSphere(0);
        }
        // The largest box measures the effect of size; its flow need not be developed.
        const int steps = cells.z > 128 ? 5 : 60;
        for (int step = 0; step < steps; ++step) {
            if (moving) setSphere(step);
            solver->step(1, sources);
        }
    }

    void setSphere(int step) {
        placeSphere(step);
        solver->setSolids({inside, {&motion, 1}});
    }
    void placeSphere(int step) {
        const float speed = moving_ ? 0.2f : 0.0f;
        motion.velocity = {speed, 0, 0};
        const glm::vec3 centre(static_cast<float>(cells_.x) * 0.5f + speed * static_cast<float>(step % 60),
                               static_cast<float>(cells_.y) * 0.45f, static_cast<float>(cells_.z) * 0.5f);
        const float radius = static_cast<float>(cells_.y) * 0.15f;
        std::size_t at = 0;
        for (int k = 0; k < cells_.z; ++k)
            for (int j = 0; j < cells_.y; ++j)
                for (int i = 0; i < cells_.x; ++i, ++at) {
                    const glm::vec3 d = glm::vec3(i, j, k) + 0.5f - centre;
                    inside[at] = glm::dot(d, d) < radius * radius ? 1 : 0;
                }
    }

    MemoryLedger ledger;
    FluidSettings settings;
    std::vector<FluidSource> sources;
    std::optional<FluidSolver> solver;
    std::vector<std::uint8_t> inside;
    BodyMotion motion;

 private:
    glm::ivec3 cells_;
    bool moving_;
};

glm::ivec3 boxOf(const benchmark::State& state) {
    return {static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), static_cast<int>(state.range(2))};
}

/// Reports the minimum memory traffic of a kernel divided by its time.
void countBytes(benchmark::State& state, double bytesPerCell) {
    const glm::dvec3 cells(boxOf(state));
    state.counters["GB/s"] = benchmark::Counter(bytesPerCell * cells.x * cells.y * cells.z * 1e-9,
                                                benchmark::Counter::kIsIterationInvariantRate);
}

/// a = b + s·c for one float per cell, with the threads that the kernels use.
void triad(benchmark::State& state) {
    const glm::ivec3 box = boxOf(state);
    const std::size_t count =
        static_cast<std::size_t>(box.x) * static_cast<std::size_t>(box.y) * static_cast<std::size_t>(box.z);
    std::vector<float> a(count), b(count, 1), c(count, 2);
    for (auto _ : state)
        parallel::forEachBlock(count, 32768, [&](std::size_t first, std::size_t n) {
            for (std::size_t i = first; i < first + n; ++i) a[i] = b[i] + 3 * c[i];
        });
    benchmark::DoNotOptimize(a.data());
    countBytes(state, 12);
}

void wholeStep(benchmark::State& state, bool moving, VelocityAt velocityAt) {
    Plume plume(boxOf(state), true, moving, velocityAt);
    StepReport report;
    int step = 60;
    for (auto _ : state) {
        if (moving) {
            state.PauseTiming();
            plume.placeSphere(step++);
            state.ResumeTiming();
            plume.solver->setSolids({plume.inside, {&plume.motion, 1}});
        }
        report = plume.solver->step(1, plume.sources);
    }
    state.counters["cycles"] = report.pressure.cycles;
    state.counters["divergence"] = static_cast<double>(report.divergencePerStep);
    state.counters["CFL"] = static_cast<double>(report.cellsPerStep);
    state.counters["bytes/voxel"] =
        static_cast<double>(plume.ledger.totalBytes()) / static_cast<double>(plume.settings.box.cellCount());
}

/// The plume's state without its solver, to run one kernel at a time.
struct Kernels {
    explicit Kernels(glm::ivec3 cells)
        : plume(cells, true),
          layout(cells),
          pressure(layout, plume.settings.sides),
          floats(std::max(pressure.floatsNeeded(), forceFloats(layout))),
          from(plume.solver->cells()),
          to(layout, plume.ledger.account("to")),
          borrowed(plume.ledger.account("borrowed")),
          advection(layout, plume.ledger.account("window")),
          solids(plume.solver->solids()) {
        borrowed.resize(floats);
        advect({});
        from.swap(to);
        fillGhosts(from, layout, {plume.settings.sides, {}, false});
    }
    void advect(AdvectionRule rule) { advection.advect(from, to, solids.moving(), rule, {1, glm::vec3(1.5f)}); }
    void build() { pressure.build(borrowed, solids.conductance()); }
    void gather() { gatherDivergence(from, layout, solids.conductance(), pressure.finest()); }

    Plume plume;
    CellLayout layout;
    PressureSolver pressure;
    std::size_t floats;
    CellField from, to;
    LedgerVector<float> borrowed;  ///< scratch as the solver provides it: aligned, in large pages
    Advection advection;
    const SolidCells& solids;
};

void advect(benchmark::State& state, AdvectionScheme scheme) {
    Kernels kernels(boxOf(state));
    for (auto _ : state) kernels.advect({.scheme = scheme});
    countBytes(state, scheme == AdvectionScheme::macCormack ? 4 * 24 : 2 * 24);
}

void forces(benchmark::State& state) {
    Kernels kernels(boxOf(state));
    // The time step is too short to change the flow over all repetitions.
    for (auto _ : state)
        applyForces(kernels.from, kernels.layout, kernels.solids.conductance(), kernels.solids.moving(),
                    kernels.plume.settings.forces, 1, 1e-9f, kernels.borrowed);
    countBytes(state, 24 + 20 + 24);
}

/// The whole projection: operator, divergence, solution and gradient.
void pressure(benchmark::State& state) {
    Kernels kernels(boxOf(state));
    PressureResult result;
    for (auto _ : state) {
        kernels.build();
        kernels.gather();
        result = kernels.pressure.solve({PressureMethod::multigrid, 0, 30, 1e-3f});
        // Write to an unused copy, so that the input stays the same.
        subtractGradient(kernels.to, kernels.layout, kernels.solids.conductance(), kernels.pressure.finest());
    }
    state.counters["cycles"] = result.cycles;
    state.counters["divergence"] = static_cast<double>(result.residual);
}

void buildOperator(benchmark::State& state) {
    Kernels kernels(boxOf(state));
    for (auto _ : state) kernels.build();
}

void divergence(benchmark::State& state) {
    Kernels kernels(boxOf(state));
    kernels.build();
    for (auto _ : state) kernels.gather();
    countBytes(state, 24 + 4);
}

void sweep(benchmark::State& state) {
    Kernels kernels(boxOf(state));
    kernels.build();
    kernels.gather();
    kernels.pressure.finest().clearPressure();
    constexpr std::array once{1.0f};
    for (auto _ : state) kernels.pressure.finest().smooth({.relaxations = once});
    countBytes(state, 4 + 4 + 4 + 1);
}

void gradient(benchmark::State& state) {
    Kernels kernels(boxOf(state));
    kernels.build();
    kernels.pressure.finest().clearPressure();
    for (auto _ : state)
        subtractGradient(kernels.from, kernels.layout, kernels.solids.conductance(), kernels.pressure.finest());
    countBytes(state, 48 + 4);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
    benchmark->Args({128, 64, 64})->Args({256, 256, 256})->Unit(benchmark::kMillisecond)->UseRealTime();
}

void stepSizes(benchmark::internal::Benchmark* benchmark) {
    benchmark->Args({128, 64, 64})->Args({256, 128, 128})->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(triad)->Apply(sizes);
BENCHMARK_CAPTURE(wholeStep, restingSphere, false, VelocityAt::begin)->Apply(stepSizes);
BENCHMARK_CAPTURE(wholeStep, movingSphere, true, VelocityAt::begin)->Apply(stepSizes);
BENCHMARK_CAPTURE(wholeStep, restingSphereByTheMiddle, false, VelocityAt::middle)->Apply(stepSizes);
BENCHMARK(pressure)->Apply(sizes);
BENCHMARK_CAPTURE(advect, macCormack, AdvectionScheme::macCormack)->Apply(sizes);
BENCHMARK_CAPTURE(advect, semiLagrangian, AdvectionScheme::semiLagrangian)->Apply(sizes);
BENCHMARK(forces)->Apply(sizes);
BENCHMARK(buildOperator)->Apply(sizes);
BENCHMARK(divergence)->Apply(sizes);
BENCHMARK(sweep)->Apply(sizes);
BENCHMARK(gradient)->Apply(sizes);

}  // namespace
}  // namespace dustbench::grid_fluid::flow
