// Ray casting a plume of 128×64×64 cells into 800×600 pixels, half a cell a step: upload and march apart.
//
// Nothing stands in the picture's way, and the readback of the scene's depths is part of the CPU's march.
#include <benchmark/benchmark.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "methods/shared/draw/test_canvas.h"
#include "methods/shared/raycast/grid_raycast.h"
#include "methods/shared/raycast/raycast_test_grid.h"

namespace dustbench::raycast {
namespace {

const TestGrid& plume() {
    static const TestGrid grid = testPlume();
    return grid;
}

draw::TestCanvas& canvas() {
    static draw::TestCanvas one = [] {
        draw::TestCanvas made(800, 600, {-1.5, 2.2, 5.2}, {1.5, -2.2, -5.2});
        made.view.camera.verticalFieldOfView = 0.75;
        return made;
    }();
    return one;
}

RaycastSettings settingsOf(Backend backend, bool skipEmpty) {
    RaycastSettings settings;
    settings.backend = backend;
    settings.skipEmpty = skipEmpty;
    settings.extinctionPerMetre = 3;
    return settings;
}

/// The picture that all others must be, within what an early stop may leave out.
const draw::Image& checkedPicture() {
    static const draw::Image image = [] {
        MemoryLedger ledger;
        GridRaycast raycast(draw::TestCanvas::device(), settingsOf(Backend::gl, false), {}, ledger);
        raycast.upload(plume().shown());
        return canvas().picture([&](const gpu::Layer& layer) { raycast.draw(canvas().view, layer); });
    }();
    return image;
}

void verify(benchmark::State& state, const draw::Image& image) {
    double worst = 0, alpha = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        worst = std::max(worst, static_cast<double>(std::abs(image.pixels[i].a - checkedPicture().pixels[i].a)));
        alpha += static_cast<double>(image.pixels[i].a);
    }
    if (worst > 0.01) throw std::logic_error("the picture is off by " + std::to_string(worst));
    state.counters["worst"] = worst;
    state.counters["mean_alpha"] = alpha / static_cast<double>(image.pixels.size());
}

void march(benchmark::State& state, Backend backend, bool skipEmpty) {
    MemoryLedger ledger;
    GridRaycast raycast(draw::TestCanvas::device(), settingsOf(backend, skipEmpty), {}, ledger);
    raycast.upload(plume().shown());
    verify(state, canvas().picture([&](const gpu::Layer& layer) { raycast.draw(canvas().view, layer); }));
    gpu::Layer& layer = canvas().layer();
    for (auto _ : state) {
        raycast.draw(canvas().view, layer);
        draw::TestCanvas::device().finish();
    }
    state.counters["rays"] = static_cast<double>(raycast.primitives());
}

void upload(benchmark::State& state, Backend backend) {
    MemoryLedger ledger;
    GridRaycast raycast(draw::TestCanvas::device(), settingsOf(backend, true), {}, ledger);
    for (auto _ : state) {
        raycast.upload(plume().shown());
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
