// Benchmarks the march, the upload and the memory of sparse volumes, on the scenes and pictures of the benchmarks of
// dense volumes (kit/raycast/raycast_bench.cpp) and of NanoVDB's own march (kit/raycast/peers). Measure those in the
// same session.
#include "methods/kit/raycast/raycast_bench_scene.h"
#include "methods/volume/sparse/sparse_picture.h"
#include "methods/volume/sparse/sparse_test_grid.h"

namespace dustbench::volume {
namespace {

using raycast::Backend, raycast::Shown;

const SparseMoment& benchMoment(Shown shown) {
    static MemoryLedger ledger;
    const auto made = [](Shown each) {
        auto* const moment = new SparseMoment(ledger, "benchmark");  // for the whole process
        fill(*moment, raycast::benchGrid(each), {0, 0, 0});
        return moment;
    };
    static const SparseMoment* const plume = made(Shown::plume);
    if (shown == Shown::plume) return *plume;
    static const SparseMoment* const trail = made(Shown::trail);
    return *trail;
}

void sparse(benchmark::State& state, Backend backend, Shown shown) {
    MemoryLedger ledger;
    SparsePicture picture(draw::TestCanvas::device(), raycast::benchSettings(backend, true), {}, ledger);
    picture.upload(benchMoment(shown));
    draw::TestCanvas& canvas = raycast::benchCanvas(shown);
    const pictures::Image image = canvas.picture([&](const gpu::Layer& to) { picture.draw(canvas.view, to); });
    verifyPicture(
        state, [&](std::size_t i) { return image.pixels[i].a; }, shown);
    gpu::Layer& layer = canvas.layer();
    for (auto _ : state) {
        picture.draw(canvas.view, layer);
        draw::TestCanvas::device().finish();
    }
    state.counters["rays"] = static_cast<double>(picture.primitives());
    state.counters["tree_MB"] = static_cast<double>(benchMoment(shown).density.bytes().size()) / 1e6;
    state.counters["box_MB"] = static_cast<double>(raycast::benchGrid(shown).density.size()) * sizeof(float) / 1e6;
}

void sparseUpload(benchmark::State& state, Backend backend, int shadowCells) {
    MemoryLedger ledger;
    raycast::RaycastSettings settings = raycast::benchSettings(backend, true);
    settings.shadowCells = shadowCells;
    SparsePicture picture(draw::TestCanvas::device(), settings, {}, ledger);
    for (auto _ : state) {
        picture.upload(benchMoment(Shown::plume));
        draw::TestCanvas::device().finish();
    }
}

void timing(benchmark::internal::Benchmark* benchmark) {
    benchmark->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

BENCHMARK_CAPTURE(sparse, cpu_plume, Backend::cpu, Shown::plume)->Apply(timing);
BENCHMARK_CAPTURE(sparse, gl_plume, Backend::gl, Shown::plume)->Apply(timing);
BENCHMARK_CAPTURE(sparse, cpu_trail, Backend::cpu, Shown::trail)->Apply(timing);
BENCHMARK_CAPTURE(sparse, gl_trail, Backend::gl, Shown::trail)->Apply(timing);
BENCHMARK_CAPTURE(sparseUpload, gl, Backend::gl, 0)->Apply(timing);
BENCHMARK_CAPTURE(sparseUpload, cpu_shadow_of_2_cells, Backend::cpu, 2)->Apply(timing);

}  // namespace
}  // namespace dustbench::volume
