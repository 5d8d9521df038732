// Benchmarks upload and drawing of 40,000 unsorted point sprites of 4 pixels against a bare draw of the same sprites.
// The bare draw binds, draws and waits; its buffer is written once. Both pictures are compared before timing.
#include "methods/voxel_shape/voxel_shape.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/voxel_shape/shape.h"
#include "methods/voxel_shape/shape_builder.h"

namespace dustbench::voxel_shape {
namespace {

using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Returns the preset `figure` at rest in the middle of the picture.
Shape figure() {
    Shape shape = readShape(files::dataFolder() / "shapes" / "figure.toml");
    shape.track.followsVehicle = false;
    shape.track.keys = {{}};
    shape.look.order = Order::none;
    return shape;
}

void spritesAgainstABareDraw(benchmark::State& state) {
    TestMoment moment(0, 640, 480, {0, 1.6, 5}, {0, 0, -1});
    const Shape shape = figure();
    MemoryLedger ledger;
    ShapeSystem system = buildShape(ledger, shape, moment.scene, TestMoment::device(), 1);
    Motion still = shape.motion;
    still.birthSpeed = still.fillSeconds = 0;
    system.step({}, still, 1.0f / 60);
    if (system.particles().size() != 40'000) throw std::runtime_error("the figure does not have 40,000 particles");
    DrawOrder order(ledger);
    const particles::ParticleStore& store = system.particles().store;
    ShapePicture picture(TestMoment::device(), shape.look);
    const auto whole = [&] {
        picture.upload(system.particles(), order.of(shape.look, {store.x, store.y, store.z}, glm::vec3(0)));
        picture.draw(moment.view, moment.layer());
        TestMoment::device().finish();
    };
    draw::Points points(TestMoment::device(), {true, shape.look.pixels, false});
    float* value = points.map(store.size(), draw::Points::layout()).data();
    for (std::size_t i = 0; i < store.size(); ++i)
        for (const float next : {store.x[i], store.y[i], store.z[i], store.radius[i], store.opacity[i], store.red[i],
                                 store.green[i], store.blue[i]})
            *value++ = next;
    points.unmap();
    const auto bare = [&] {
        points.draw(moment.view, moment.layer());
        TestMoment::device().finish();
    };
    const auto pictureOf = [&](const auto& loop) { return moment.picture([&](const gpu::Layer&) { loop(); }); };
    if (pictureOf(whole).pixels != pictureOf(bare).pixels)
        throw std::runtime_error("the two loops draw different pictures");

    std::vector<double> bareTimes, wholeTimes, shares;
    for (auto _ : state) {
        const auto timed = [&](const auto& loop) {
            moment.layer().clear();
            TestMoment::device().finish();
            const auto start = Clock::now();
            loop();
            return std::chrono::duration<double>(Clock::now() - start).count();
        };
        const bool bareFirst = bareTimes.size() % 2 == 0;
        if (bareFirst) bareTimes.push_back(timed(bare));
        wholeTimes.push_back(timed(whole));
        if (!bareFirst) bareTimes.push_back(timed(bare));
        shares.push_back(bareTimes.back() / wholeTimes.back());
        state.SetIterationTime(wholeTimes.back());
    }
    state.counters["bare_ms"] = median(bareTimes) * 1000;
    state.counters["whole_ms"] = median(wholeTimes) * 1000;
    state.counters["share_of_bare"] = median(shares);
}
BENCHMARK(spritesAgainstABareDraw)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(3);

/// Updates a frame without drawing, in each order.
void update(benchmark::State& state, Order order) {
    TestMoment moment(0, 640, 480, {0, 1.6, 5}, {0, 0, -1});
    Shape shape = figure();
    shape.look.order = order;
    VoxelShape method(shape);
    method.prepare(moment.scene, {}, TestMoment::device());
    for (int step = 0; step < 60; ++step) method.update(moment.frame());
    for (auto _ : state) method.update(moment.frame());
    state.counters["particles"] = static_cast<double>(method.system().particles().size());
}
#define ORDER(name) BENCHMARK_CAPTURE(update, name, Order::name)->UseRealTime()->Unit(benchmark::kMillisecond)
ORDER(quicksort);
ORDER(radix);
ORDER(nearest);
ORDER(every);
ORDER(none);

}  // namespace
}  // namespace dustbench::voxel_shape
