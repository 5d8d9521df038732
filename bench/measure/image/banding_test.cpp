#include "bench/measure/image/banding.h"

#include <gtest/gtest.h>

#include <numbers>

#include "bench/measure/image/test_images.h"
#include "methods/contract/errors.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::bench {
namespace {

constexpr int width = 200, height = 160;

Mask everywhere() {
    const Plane all = planeOf(width, height, [](int, int) { return 1; });
    return dustMask(all, all);
}

Picture grey() {
    return pictureOf(width, height, [](int, int, int) { return 0.5; });
}

double bandingOf(const Formula& error, const Mask& mask = everywhere()) {
    return *banding(grey(), pictureOf(width, height, [&](int x, int y, int c) { return 0.5 + error(x, y, c); }), mask);
}

TEST(Banding, OfAWaveIsWhatFiveSamplesOfItLeave) {
    // Inside the picture, where windows are whole: mean of five samples of a wave is sin(5πf)/(5 sin πf) of it.
    const Plane middle =
        planeOf(width, height, [](int x, int y) { return x > 1 && y > 1 && x < width - 2 && y < height - 2; });
    for (const int wavelength : {7, 10, 20, 40}) {
        const double f = 1.0 / wavelength;
        const double left = std::abs(std::sin(5 * std::numbers::pi * f) / (5 * std::sin(std::numbers::pi * f)));
        const auto wave = [=](int x, int, int) { return 0.1 * std::sin(2 * std::numbers::pi * (x + 0.3) * f); };
        const double whole =
            *maskedError(grey(), pictureOf(width, height, [&](int x, int y, int c) { return 0.5 + wave(x, y, c); }),
                         dustMask(middle, middle))
                 .rmseLinear;
        // The windows of the two outermost columns of the mask are narrower than the others.
        EXPECT_NEAR(bandingOf(wave, dustMask(middle, middle)) / whole, left, 0.03) << wavelength;
    }
    EXPECT_NEAR(bandingOf([](int, int, int) { return 0.1; }), 0.1, 1e-6);
}

TEST(Banding, IndependentNoiseFallsByTheRootOfTheWindow) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const auto noise = [=](int x, int y, int c) {
            const auto u =
                maths::uniform4(seed, static_cast<std::uint64_t>(c), static_cast<std::uint64_t>(y * width + x));
            return 0.2 * static_cast<double>(maths::centred(u[0]));
        };
        const Picture noisy = pictureOf(width, height, [&](int x, int y, int c) { return 0.5 + noise(x, y, c); });
        const double whole = *maskedError(grey(), noisy, everywhere()).rmseLinear;
        // 96,000 values whose windows overlap 25-fold: 1/√(2·3840) = 1.1 % standard error; windows at the edge are
        // smaller.
        EXPECT_NEAR(*banding(grey(), noisy, everywhere()) / whole, 1.0 / bandingWindow, 0.01);
    }
}

TEST(Banding, StaysWithinTheMaskAndIsEmptyWithoutOne) {
    const Plane left = planeOf(width, height, [](int x, int) { return x < 60; });
    const Mask mask = dustMask(left, left);
    const auto outside = [](int x, int, int) { return x >= 60 ? 0.4 : 0.1; };
    EXPECT_NEAR(bandingOf(outside, mask), 0.1, 1e-6) << "pixels outside the mask must not count";
    EXPECT_EQ(banding(grey(), grey(), mask), 0);
    EXPECT_EQ(banding(grey(), grey(), dustMask(Plane(width, height), Plane(width, height))), std::nullopt);
    EXPECT_THROW((void)banding(grey(), grey(), Mask(3, 3)), InputError);
}

}  // namespace
}  // namespace dustbench::bench
