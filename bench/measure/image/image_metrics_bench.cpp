// Cost of all image metrics for one frame: 640×480, two pictures of dust. Target: 0.5 s on two cores.
#include <benchmark/benchmark.h>

#include "bench/measure/image/flaw_metrics.h"
#include "bench/measure/image/picture_error.h"
#include "bench/measure/image/popping.h"
#include "bench/measure/image/test_splatter.h"

namespace dustbench::measure {
namespace {

/// 5,000 puffs over half of the picture; the method's are displaced by up to three pixels.
struct Frame {
    TestView view{640, 480, {}};
    std::vector<TestPuff> puffs, displaced;
    Plane alpha, reference;
    pictures::Image image, referenceImage;

    Frame() {
        for (std::uint64_t i = 0; i < 5'000; ++i) {
            const auto [x, y] = testUniform(1, i);
            const auto [dx, dy] = testUniform(2, i);
            puffs.push_back({640 * x, 200 + 240 * y, 0, 12, 0.05, -1});
            displaced.push_back({640 * x + 6 * dx - 3, 200 + 240 * y + 6 * dy - 3, 0, 12, 0.05, -1});
        }
        alpha = testAlpha(displaced, view);
        reference = testAlpha(puffs, view);
        image = imageOf(alpha);
        referenceImage = imageOf(reference);
    }
    static pictures::Image imageOf(const Plane& alpha) {
        pictures::Image image{alpha.width, alpha.height, {}};
        const Picture picture = testPicture(alpha);
        for (std::size_t i = 0; i < alpha.values.size(); ++i)
            image.pixels.emplace_back(picture.linear[0].values[i], picture.linear[1].values[i],
                                      picture.linear[2].values[i], 1.0f);
        return image;
    }
    static const Frame& get() {
        static const Frame frame;
        return frame;
    }
};

void allMetricsOfAFrame(benchmark::State& state) {
    const Frame& frame = Frame::get();
    const std::vector<ScreenPrimitive> primitives = testPrimitives(frame.displaced);
    const Picture before = preparePicture(frame.referenceImage, "the frame before");
    for ([[maybe_unused]] auto _ : state) {
        const Picture reference = preparePicture(frame.referenceImage, "the reference");
        const Picture picture = preparePicture(frame.image, "the picture");
        benchmark::DoNotOptimize(pictureError(reference, picture));
        benchmark::DoNotOptimize(ssim(reference, picture));
        benchmark::DoNotOptimize(flip(reference, picture));
        benchmark::DoNotOptimize(popping({before, before, frame.reference, frame.reference},
                                         {picture, reference, frame.alpha, frame.reference}));
        benchmark::DoNotOptimize(gaps(frame.alpha, frame.reference));
        benchmark::DoNotOptimize(components(frame.alpha, frame.reference));
        benchmark::DoNotOptimize(cutoff(frame.alpha, frame.alpha, frame.reference, frame.reference));
        benchmark::DoNotOptimize(selfSimilarity(frame.alpha, frame.reference, primitives, 1));
        benchmark::DoNotOptimize(quadsPerPixel(5'000, frame.reference));
    }
}
BENCHMARK(allMetricsOfAFrame)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A metric that compares two pictures.
template <auto metric>
void onPictures(benchmark::State& state) {
    const Picture reference = preparePicture(Frame::get().referenceImage, "the reference");
    const Picture picture = preparePicture(Frame::get().image, "the picture");
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(metric(reference, picture));
}
BENCHMARK(onPictures<pictureError>)
    ->Name("psnr_db rmse_linear identical")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(onPictures<ssim>)->Name("ssim")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(onPictures<[](const Picture& a, const Picture& b) { return flip(a, b); }>)
    ->Name("flip")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void selfSimilarityOf5000Puffs(benchmark::State& state) {
    const Frame& frame = Frame::get();
    const std::vector<ScreenPrimitive> primitives = testPrimitives(frame.displaced);
    for ([[maybe_unused]] auto _ : state)
        benchmark::DoNotOptimize(selfSimilarity(frame.alpha, frame.reference, primitives, 1));
}
BENCHMARK(selfSimilarityOf5000Puffs)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace dustbench::measure
