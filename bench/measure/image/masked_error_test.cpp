#include "bench/measure/image/masked_error.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "bench/measure/image/picture_error.h"
#include "bench/measure/image/test_images.h"
#include "methods/contract/errors.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::measure {
namespace {

/// A method's and a reference's layer, as formulas: colour and alpha of dust around the origin, over an even sky.
struct Cloud {
    std::uint64_t seed;
    [[nodiscard]] double alpha(double x, double y, double shift) const {
        double rest = 1;
        for (std::uint64_t i = 0; i < 12; ++i) {
            const auto a = maths::uniform4(seed, 1, i);
            const double dx = x - shift - 10 * static_cast<double>(maths::centred(a[0])),
                         dy = y - 8 * static_cast<double>(maths::centred(a[1]));
            const double s = 2 + 2 * static_cast<double>(a[2]);
            rest *= 1 - 0.6 * static_cast<double>(a[3]) * std::exp(-(dx * dx + dy * dy) / (2 * s * s));
        }
        return 1 - rest;
    }
};

struct MaskScores {
    std::optional<double> psnr, rmse, maximum, ssim, flip;
    double wholeSsim, wholeRmse;
    bool operator==(const MaskScores&) const = default;
};

constexpr std::array<double, 3> dust{0.7, 0.5, 0.3}, sky{0.25, 0.45, 0.8};

/// The cloud in the middle of a picture, with `border` pixels of sky around.
MaskScores scoresWithSky(const Cloud& cloud, int border) {
    const int width = 70 + 2 * border, height = 60 + 2 * border;
    const auto alphaAt = [&](double shift) {
        return [=](int x, int y) { return cloud.alpha(x - 0.5 * width + 0.5, y - 0.5 * height + 0.5, shift); };
    };
    const auto pictureAt = [&](double shift) {
        return pictureOf(width, height, [=, alpha = alphaAt(shift)](int x, int y, int c) {
            const auto channel = static_cast<std::size_t>(c);
            return sky[channel] + (dust[channel] - sky[channel]) * alpha(x, y);
        });
    };
    const Picture reference = pictureAt(0), picture = pictureAt(1.5);
    const Mask mask = dustMask(planeOf(width, height, alphaAt(1.5)), planeOf(width, height, alphaAt(0)));
    const MaskedError error = maskedError(reference, picture, mask);
    const Measured similarity = ssim(reference, picture);
    return {error.psnrDb,
            error.rmseLinear,
            error.maximum,
            meanWithin(similarity.map, mask),
            meanWithin(flip(reference, picture).map, mask),
            *similarity.value,
            pictureError(reference, picture).rmseLinear};
}

TEST(MaskedError, SkyAroundTheDustChangesNothing) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const MaskScores close = scoresWithSky({seed}, 0);
        ASSERT_TRUE(close.psnr && close.rmse && close.maximum && close.ssim && close.flip);
        for (const int border : {1, 17, 60}) {
            const MaskScores wide = scoresWithSky({seed}, border);
            // The sums have more terms of 0 only; FLIP is in single precision.
            EXPECT_NEAR(*wide.psnr, *close.psnr, 1e-9);
            EXPECT_NEAR(*wide.rmse, *close.rmse, 1e-12);
            EXPECT_EQ(*wide.maximum, *close.maximum);
            EXPECT_NEAR(*wide.ssim, *close.ssim, 1e-9);
            EXPECT_NEAR(*wide.flip, *close.flip, 1e-5);
            // The purpose of the mask: means over the whole picture are dominated by the sky.
            EXPECT_GT(wide.wholeSsim, close.wholeSsim);
            EXPECT_LT(wide.wholeRmse, close.wholeRmse);
        }
    }
}

TEST(MaskedError, AConstantOffsetWithinTheMaskHasItsClosedForm) {
    // Encoded c and c + d within the mask, and a difference outside it that must not count.
    const auto inside = [](int x, int y) { return x >= 12 && x < 40 && y >= 8 && y < 31; };
    const auto even = [&](float within, float outside) {
        return pictureOf(60, 50, [=](int x, int y, int) { return maths::decodeSrgb(inside(x, y) ? within : outside); });
    };
    const Plane alpha = planeOf(60, 50, [&](int x, int y) { return inside(x, y) ? 0.5 : 1.0 / 255; });
    const Mask mask = dustMask(alpha, Plane(60, 50));
    const Picture a = even(0.5f, 0.1f), b = even(0.6f, 0.9f);
    const MaskedError error = maskedError(a, b, mask);
    EXPECT_NEAR(*error.psnrDb, 20, 1e-4);
    const float step = maths::decodeSrgb(0.6f) - maths::decodeSrgb(0.5f);
    EXPECT_NEAR(*error.rmseLinear, step, 1e-6f);
    EXPECT_NEAR(*error.maximum, step, 1e-6f);
    EXPECT_EQ(maskedError(a, even(0.5f, 0.9f), mask).psnrDb, std::nullopt);
    EXPECT_EQ(maskedError(a, even(0.5f, 0.9f), mask).rmseLinear, 0);
}

TEST(MaskedError, TheMaximumIsThatOfOnePixelAndChannelWhateverItsSign) {
    for (const double sign : {-1.0, 1.0}) {
        const Picture a = pictureOf(20, 20, [](int, int, int) { return 0.5; });
        const Picture b = pictureOf(20, 20, [=](int x, int y, int c) {
            return 0.5 + (x == 7 && y == 3 && c == 1 ? sign * 0.3 : x == 9 ? 0.1 : 0) + (x == 0 ? 0.5 : 0);
        });
        const Mask mask = dustMask(planeOf(20, 20, [](int x, int) { return x > 0 ? 1 : 0; }), Plane(20, 20));
        EXPECT_NEAR(*maskedError(a, b, mask).maximum, 0.3, 1e-7);
    }
}

TEST(MaskedError, SsimCountsTheWindowsWhoseCentreIsInTheMask) {
    const Picture a = pictureOf(pairWidth, pairHeight, waves().reference);
    const Picture b = pictureOf(pairWidth, pairHeight, waves().image);
    const Plane map = ssim(a, b).map;
    const auto only = [](int px, int py) {
        return dustMask(planeOf(pairWidth, pairHeight, [=](int x, int y) { return x == px && y == py; }),
                        Plane(pairWidth, pairHeight));
    };
    EXPECT_EQ(meanWithin(map, only(40, 30)), map.at(35, 25));
    EXPECT_EQ(meanWithin(map, only(5, 5)), map.at(0, 0));
    EXPECT_EQ(meanWithin(map, only(4, 30)), std::nullopt);  // its window is not wholly inside
    const Plane all = planeOf(pairWidth, pairHeight, [](int, int) { return 1; });
    EXPECT_NEAR(*meanWithin(map, dustMask(all, all)), *ssim(a, b).value, 1e-6);
    EXPECT_NEAR(*maskedError(a, b, dustMask(all, all)).psnrDb, *pictureError(a, b).psnrDb, 1e-9);
}

TEST(MaskedError, TheMaskIsWhatEitherShowsAboveOneStepOfEightBits) {
    const auto plane = [](float value) { return planeOf(1, 1, [=](int, int) { return value; }); };
    EXPECT_EQ(dustMask(plane(1.0f / 255), plane(0)).values[0], 0);
    EXPECT_EQ(dustMask(plane(1.01f / 255), plane(0)).values[0], 1);
    EXPECT_EQ(dustMask(plane(0), plane(1.01f / 255)).values[0], 1);
    EXPECT_EQ(dustMask(plane(0), plane(0)).values[0], 0);
    EXPECT_THROW((void)dustMask(plane(0), Plane(2, 1)), InputError);
}

TEST(MaskedError, IsEmptyWithoutDust) {
    const Picture a = pictureOf(30, 30, [](int, int, int) { return 0.5; });
    const Picture b = pictureOf(30, 30, [](int, int, int) { return 0.6; });
    const Mask none = dustMask(Plane(30, 30), Plane(30, 30));
    const MaskedError error = maskedError(a, b, none);
    EXPECT_FALSE(error.psnrDb || error.rmseLinear || error.maximum);
    EXPECT_FALSE(meanWithin(ssim(a, b).map, none));
    EXPECT_FALSE(meanWithin(Plane(), none));  // of pictures smaller than a window
}

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
}  // namespace dustbench::measure
