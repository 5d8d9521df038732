// A smoke step of 128×64×64 cells past a sphere, whole and by kernel, beside the memory's own speed.
//
// Spacing and step are 1, so that speeds are cells per step and the greatest divergence is that of other solvers.
// `GB/s` is what a kernel must move at least, by its time; hold it against Triad in the same run.
#include <benchmark/benchmark.h>

#include <cmath>
#include <optional>
#include <vector>

#include "methods/shared/fluid/fluid_solver.h"
#include "methods/shared/parallel/for_each_block.h"

namespace dustbench::fluid {
namespace {

/// A plume that has risen past a sphere.
class Plume {
 public:
    Plume(glm::ivec3 cells, bool withSphere, bool moving = false) : cells_(cells), moving_(moving) {
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
            velocity.resize(inside.size());
            setSphere(0);
        }
        for (int step = 0; step < 60; ++step) {
            if (moving) setSphere(step);
            solver->step(1, sources);
        }
    }

    void setSphere(int step) {
        const float speed = moving_ ? 0.2f : 0.0f;
        const glm::vec3 centre(static_cast<float>(cells_.x) * 0.5f + speed * static_cast<float>(step % 60),
                               static_cast<float>(cells_.y) * 0.45f, static_cast<float>(cells_.z) * 0.5f);
        const float radius = static_cast<float>(cells_.y) * 0.15f;
        std::size_t at = 0;
        for (int k = 0; k < cells_.z; ++k)
            for (int j = 0; j < cells_.y; ++j)
                for (int i = 0; i < cells_.x; ++i, ++at) {
                    const glm::vec3 d = glm::vec3(i, j, k) + 0.5f - centre;
                    inside[at] = glm::dot(d, d) < radius * radius ? 1 : 0;
                    velocity[at] = {speed, 0, 0};
                }
        solver->setSolids({inside, velocity});
    }

    MemoryLedger ledger;
    FluidSettings settings;
    std::vector<FluidSource> sources;
    std::optional<FluidSolver> solver;
    std::vector<std::uint8_t> inside;
    std::vector<glm::vec3> velocity;

 private:
    glm::ivec3 cells_;
    bool moving_;
};

glm::ivec3 boxOf(const benchmark::State& state) {
    return {static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), static_cast<int>(state.range(2))};
}

void wholeStep(benchmark::State& state) {
    Plume plume(boxOf(state), true);
    StepReport report;
    for (auto _ : state) report = plume.solver->step(1, plume.sources);
    state.counters["cycles"] = report.pressure.cycles;
    state.counters["divergence"] = static_cast<double>(report.divergencePerStep);
    state.counters["CFL"] = static_cast<double>(report.cellsPerStep);
    state.counters["bytes/voxel"] =
        static_cast<double>(plume.ledger.totalBytes()) / static_cast<double>(plume.settings.box.cellCount());
}

}  // namespace
}  // namespace dustbench::fluid

using namespace dustbench::fluid;
BENCHMARK(wholeStep)->Args({128, 64, 64})->Unit(benchmark::kMillisecond)->UseRealTime();
