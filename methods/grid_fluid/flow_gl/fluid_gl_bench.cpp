// Benchmarks a smoke step past a sphere with the CPU solver and the GPU solver (on the device that OpenGL uses).
//
// Spacing and time step are 1, as in fluid_bench.cpp. The benchmark waits for the GPU after each stage, so that
// `advect_ms` and the others are the times of the stages. The column CPU is the sum over all threads, which allows
// comparisons while other programs run.
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <vector>

#include "methods/grid_fluid/flow/fluid_solver.h"
#include "methods/grid_fluid/flow_gl/gl_fluid_solver.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using Clock = std::chrono::steady_clock;

gpu::Device& device() {
    static gpu::Device one;
    return one;
}

/// Times the stages of a step, each including the work that it has queued.
class Stages final : public StageListener {
 public:
    void begin(Stage) override {}
    void end(Stage) override {}
    void beginDetail(std::string_view) override { began_ = Clock::now(); }
    void endDetail(std::string_view name) override {
        device().finish();
        const double ms = std::chrono::duration<double, std::milli>(Clock::now() - began_).count();
        milliseconds_[name == "advect" ? 0 : name == "forces" ? 1 : 2] += ms;
    }
    void tell(benchmark::State& state) const {
        constexpr std::array names{"advect_ms", "forces_ms", "project_ms"};
        for (std::size_t s = 0; s < names.size(); ++s)
            state.counters[names[s]] = benchmark::Counter(milliseconds_[s], benchmark::Counter::kAvgIterations);
    }

 private:
    Clock::time_point began_;
    std::array<double, 3> milliseconds_{};
};

template <typename Solver>
void step(benchmark::State& state, Solver& solver, bool moving) {
    const glm::ivec3 cells = solver.box().cells;
    flow::FluidSource source;
    source.centreMetres = {cells.x * 0.5, cells.y * 0.1, cells.z * 0.5};
    source.radiusMetres = cells.y * 0.06;
    source.densityPerSecond = 0.3f;
    source.kelvinPerSecond = 1;
    const std::vector<flow::FluidSource> sources{source};
    flow::BodyMotion motion;
    motion.velocity.x = moving ? 0.2f : 0.0f;
    std::vector<std::uint8_t> inside(solver.box().cellCount());
    const auto place = [&](int at) {
        const glm::vec3 centre =
            glm::vec3(cells) * glm::vec3(0.5f, 0.45f, 0.5f) + motion.velocity * static_cast<float>(at % 60);
        const float radius = static_cast<float>(cells.y) * 0.15f;
        std::size_t cell = 0;
        for (int k = 0; k < cells.z; ++k)
            for (int j = 0; j < cells.y; ++j)
                for (int i = 0; i < cells.x; ++i)
                    inside[cell++] = glm::distance(glm::vec3(i, j, k) + 0.5f, centre) < radius ? 1 : 0;
    };
    place(0);
    solver.setSolids({inside, {&motion, 1}});
    int number = 0;
    for (; number < 60; ++number) solver.step(1, sources);
    Stages stages;
    const StageClock clock(&stages);
    flow::StepReport report;
    for (auto _ : state) {
        if (moving) {
            state.PauseTiming();
            place(++number);
            state.ResumeTiming();
            solver.setSolids({inside, {&motion, 1}});
        }
        report = solver.step(1, sources, clock);
    }
    stages.tell(state);
    state.counters["cycles"] = report.pressure.cycles;
    state.counters["divergence"] = static_cast<double>(report.divergencePerStep);
    state.counters["CFL"] = static_cast<double>(report.cellsPerStep);
}

flow::FluidSettings settingsOf(const benchmark::State& state) {
    flow::FluidSettings settings;
    settings.box = {
        {static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), static_cast<int>(state.range(2))},
        1.0,
        {0, 0, 0}};
    settings.forces.buoyancyPerKelvin = 0.01f;
    settings.forces.confinementPerSecond = 0.05f;
    settings.forces.densityDecayPerSecond = 0.001f;
    return settings;
}

void onCpu(benchmark::State& state, bool moving) {
    MemoryLedger ledger;
    flow::FluidSolver solver(settingsOf(state), ledger);
    step(state, solver, moving);
}

void onGpu(benchmark::State& state, bool moving) {
    MemoryLedger ledger;
    GlFluidSolver solver(settingsOf(state), device(), ledger);
    step(state, solver, moving);
    std::size_t bytes = 0;
    for (const MemoryUse& use : solver.gpuMemory()) bytes += use.gpuBytes;
    state.counters["bytes/voxel"] = static_cast<double>(bytes) / static_cast<double>(solver.box().cellCount());
    state.SetLabel(device().info().renderer);
}

void size(benchmark::internal::Benchmark* benchmark) {
    benchmark->Args({128, 64, 64})->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

BENCHMARK_CAPTURE(onCpu, restingSphere, false)->Apply(size);
BENCHMARK_CAPTURE(onGpu, restingSphere, false)->Apply(size);
BENCHMARK_CAPTURE(onCpu, movingSphere, true)->Apply(size);
BENCHMARK_CAPTURE(onGpu, movingSphere, true)->Apply(size);

}  // namespace
}  // namespace dustbench::grid_fluid::flow_gl
