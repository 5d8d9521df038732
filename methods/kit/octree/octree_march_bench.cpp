// Benchmarks ray marching through the tree: the whole pass with upload and wait, and the pass alone.
//
// A trail of 60 m in a world of 128 m at 640×480: from the side, from a chase camera, and from within.
#include <benchmark/benchmark.h>

#include <optional>

#include "methods/kit/draw/read_back.h"
#include "methods/kit/octree/octree_march.h"
#include "methods/kit/octree/octree_march_test_tree.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::octree {
namespace {

enum Place { aside, chasing, within };

scene::View viewFrom(Place place) {
    scene::View view;
    view.width = 640;
    view.height = 480;
    if (place == aside) {
        view.camera.eye = {5, 6, 45};
        view.camera.target = {0, 1, 5};
    } else if (place == chasing) {
        view.camera.eye = {42, 3, -6};
        view.camera.target = {20, 1, 4};
    } else {
        view.camera.eye = {0.3, 1.5, 11};
        view.camera.target = {30, 1, 0};
    }
    return view;
}

class Workload {
 public:
    Workload(Place place, int depth, std::size_t voxels)
        : tree({glm::dvec3(-64), 128, depth}), view(viewFrom(place)), march(device) {
        tree = trailTree(tree.lattice(), voxels);
        depth_ = gpu::Texture::make2D(device, "scene depth", gpu::Format::depth32F, view.width, view.height);
        gpu::Framebuffer(device, "scene depth", nullptr, &depth_).clearDepth();
        layer.emplace(device, depth_);
    }

    void draw() {
        layer->clear();
        march.draw(view, {0.75f, 0.6f, 0.45f}, *layer);
        device.finish();
    }

    gpu::Device device;
    TestTree tree;
    scene::View view;
    std::optional<gpu::Layer> layer;
    OctreeMarch march;

 private:
    gpu::Texture depth_;
};

void drawOnly(benchmark::State& state, Place place, bool coloured) {
    Workload work(place, static_cast<int>(state.range(0)), static_cast<std::size_t>(state.range(1)));
    work.march.upload(work.tree.marched(coloured));
    work.draw();
    for (auto _ : state) work.draw();
    double alpha = 0;
    const pictures::Image image = draw::readBack(work.layer->colour());
    for (const glm::vec4& pixel : image.pixels) alpha += static_cast<double>(pixel.a);
    state.counters["mean_alpha"] = alpha / static_cast<double>(image.pixels.size());
}

void uploadOnly(benchmark::State& state, bool coloured) {
    Workload work(aside, static_cast<int>(state.range(0)), static_cast<std::size_t>(state.range(1)));
    for (auto _ : state) {
        work.march.upload(work.tree.marched(coloured));
        work.device.finish();
    }
    state.counters["blocks"] = static_cast<double>(work.tree.marched().blocks.size());
    state.counters["gpu_bytes"] = static_cast<double>(work.march.gpuBytes());
}

void sizes(benchmark::internal::Benchmark* benchmark) {
    benchmark->Args({8, 3'000})
        ->Args({10, 30'000})
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->MeasureProcessCPUTime();
}

BENCHMARK_CAPTURE(drawOnly, aside, aside, false)->Apply(sizes);
BENCHMARK_CAPTURE(drawOnly, chasing, chasing, false)->Apply(sizes);
BENCHMARK_CAPTURE(drawOnly, within, within, false)->Apply(sizes);
BENCHMARK_CAPTURE(drawOnly, aside_coloured, aside, true)->Apply(sizes);
BENCHMARK_CAPTURE(uploadOnly, one_colour, false)->Apply(sizes);
BENCHMARK_CAPTURE(uploadOnly, coloured, true)->Apply(sizes);

}  // namespace
}  // namespace dustbench::octree
