// Benchmarks ray casting of a plume and of a trail: upload and march separately. The CPU march includes the readback of
// the scene's depths.
#include "methods/kit/raycast/raycast_bench_scene.h"

namespace dustbench::raycast {
namespace {

void march(benchmark::State& state, Backend backend, bool skipEmpty, Shown shown = Shown::plume) {
    MemoryLedger ledger;
    GridRaycast raycast(draw::TestCanvas::device(), benchSettings(backend, skipEmpty), {}, ledger);
    raycast.upload(benchGrid(shown).shown());
    draw::TestCanvas& canvas = benchCanvas(shown);
    const pictures::Image image = canvas.picture([&](const gpu::Layer& to) { raycast.draw(canvas.view, to); });
    verifyPicture(
        state, [&](std::size_t i) { return image.pixels[i].a; }, shown);
    gpu::Layer& layer = canvas.layer();
    for (auto _ : state) {
        raycast.draw(canvas.view, layer);
        draw::TestCanvas::device().finish();
    }
    const auto& density = benchGrid(shown).density;
    state.counters["filled"] = static_cast<double>(std::ranges::count_if(density, [](float d) { return d > 0; })) /
                               static_cast<double>(density.size());
    state.counters["rays"] = static_cast<double>(raycast.primitives());
}

void upload(benchmark::State& state, Backend backend, int shadowCells) {
    MemoryLedger ledger;
    RaycastSettings settings = benchSettings(backend, true);
    settings.shadowCells = shadowCells;
    GridRaycast raycast(draw::TestCanvas::device(), settings, {}, ledger);
    for (auto _ : state) {
        raycast.upload(benchGrid().shown());
        draw::TestCanvas::device().finish();
    }
}

void timing(benchmark::internal::Benchmark* benchmark) {
    benchmark->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

BENCHMARK_CAPTURE(march, gl_plain, Backend::gl, false)->Apply(timing);
BENCHMARK_CAPTURE(march, gl_skipping, Backend::gl, true)->Apply(timing);
BENCHMARK_CAPTURE(march, cpu_plain, Backend::cpu, false)->Apply(timing);
BENCHMARK_CAPTURE(march, cpu_skipping, Backend::cpu, true, Shown::plume)->Apply(timing);
BENCHMARK_CAPTURE(march, gl_trail, Backend::gl, true, Shown::trail)->Apply(timing);
BENCHMARK_CAPTURE(march, cpu_trail, Backend::cpu, true, Shown::trail)->Apply(timing);
BENCHMARK_CAPTURE(upload, gl, Backend::gl, 0)->Apply(timing);
BENCHMARK_CAPTURE(upload, cpu, Backend::cpu, 0)->Apply(timing);
BENCHMARK_CAPTURE(upload, cpu_shadow_of_4_cells, Backend::cpu, 4)->Apply(timing);
BENCHMARK_CAPTURE(upload, cpu_shadow_of_2_cells, Backend::cpu, 2)->Apply(timing);

}  // namespace
}  // namespace dustbench::raycast
