// Ray casting a plume: upload and march apart. The readback of the scene's depths is part of the CPU's march.
#include "methods/shared/raycast/raycast_bench_scene.h"

namespace dustbench::raycast {
namespace {

void march(benchmark::State& state, Backend backend, bool skipEmpty) {
    MemoryLedger ledger;
    GridRaycast raycast(draw::TestCanvas::device(), benchSettings(backend, skipEmpty), {}, ledger);
    raycast.upload(benchPlume().shown());
    const draw::Image image =
        benchCanvas().picture([&](const gpu::Layer& to) { raycast.draw(benchCanvas().view, to); });
    verifyPicture(state, [&](std::size_t i) { return image.pixels[i].a; });
    gpu::Layer& layer = benchCanvas().layer();
    for (auto _ : state) {
        raycast.draw(benchCanvas().view, layer);
        draw::TestCanvas::device().finish();
    }
    state.counters["rays"] = static_cast<double>(raycast.primitives());
}

void upload(benchmark::State& state, Backend backend) {
    MemoryLedger ledger;
    GridRaycast raycast(draw::TestCanvas::device(), benchSettings(backend, true), {}, ledger);
    for (auto _ : state) {
        raycast.upload(benchPlume().shown());
        draw::TestCanvas::device().finish();
    }
}

void timing(benchmark::internal::Benchmark* benchmark) {
    benchmark->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

BENCHMARK_CAPTURE(march, gl_plain, Backend::gl, false)->Apply(timing);
BENCHMARK_CAPTURE(march, gl_skipping, Backend::gl, true)->Apply(timing);
BENCHMARK_CAPTURE(march, cpu_plain, Backend::cpu, false)->Apply(timing);
BENCHMARK_CAPTURE(march, cpu_skipping, Backend::cpu, true)->Apply(timing);
BENCHMARK_CAPTURE(upload, gl, Backend::gl)->Apply(timing);
BENCHMARK_CAPTURE(upload, cpu, Backend::cpu)->Apply(timing);

}  // namespace
}  // namespace dustbench::raycast
