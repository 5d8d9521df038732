// Frames of the window without its panels: billboards next to power moments, as `dustbench view` shows them.
//
// Target: 15 frames per second at 320×240 with 3,000 particles on two cores without a GPU.
#include "bench/view/viewer.h"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>

namespace dustbench::view {
namespace {

/// A frame of billboards next to moments. Arguments: height of the pictures (width:height = 4:3); 1: draw visible parts
/// only, as the window does if frames are slow; 1: moments on the left, where more of the dust is.
void shownFrame(benchmark::State& state) {
    gpu::Device device;
    ViewState shown;
    const auto height = static_cast<int>(state.range(0));
    shown.size = {height * 4 / 3, height};
    shown.world = {{"particles", "3000"}};
    const bool momentsLeft = state.range(2) == 1;
    shown.a.method = momentsLeft ? "moment_oit" : "billboard";
    shown.b = HalfState{momentsLeft ? "billboard" : "moment_oit", {}};
    Viewer viewer(shown, device, std::filesystem::temp_directory_path());
    viewer.keepsPace = true;
    viewer.drawsOnlyShown = state.range(1) == 1;
    while (viewer.session().stepsToGo() > 0) viewer.advance(1);
    FrameCost sum;
    for (auto _ : state) {
        viewer.advance();
        device.finish();
        const FrameCost& cost = viewer.costs().back();
        sum.world += cost.world;
        for (const std::size_t half : {0U, 1U})
            for (std::size_t stage = 0; stage < stageNames.size(); ++stage) {
                sum.halves[half].update[stage] += cost.halves[half].update[stage];
                sum.halves[half].draw[stage] += cost.halves[half].draw[stage];
            }
    }
    const auto note = [&](const std::string& name, double ms) {
        if (ms > 0) state.counters[name + "_ms"] = benchmark::Counter(ms, benchmark::Counter::kAvgIterations);
    };
    note("world", sum.world);
    for (const std::size_t half : {0U, 1U})
        for (std::size_t stage = 0; stage < stageNames.size(); ++stage)
            note((half == 0 ? "A_" : "B_") + std::string(stageNames[stage]),
                 sum.halves[half].update[stage] + sum.halves[half].draw[stage]);
}

}  // namespace

BENCHMARK(shownFrame)->ArgsProduct({{120, 240, 480}, {0, 1}, {0, 1}})->Unit(benchmark::kMillisecond)->MinTime(2);

}  // namespace dustbench::view
