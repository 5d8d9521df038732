#include "methods/relief/legibility_experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/maths/srgb.h"
#include "methods/relief/view_angle_experiment.h"

namespace dustbench::relief {
namespace {

pictures::Image noise(unsigned seed, float amplitude, const pictures::Image* over = nullptr) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> any(0, 1);
    pictures::Image image{48, 40, {}};
    for (std::size_t i = 0; i < 48 * 40; ++i) {
        const glm::vec3 base = over ? glm::vec3(over->pixels[i]) : glm::vec3(0);
        image.pixels.emplace_back(glm::mix(base, glm::vec3(any(random)), amplitude), 1.0f);
    }
    return image;
}

/// Wang2004, (13), for one window of 11×11 pixels around (x, y), by definition.
double similarityAt(const std::vector<double>& r, const std::vector<double>& i, int width, int x, int y) {
    double total = 0, mr = 0, mi = 0, rr = 0, ii = 0, ri = 0;
    for (int v = -5; v <= 5; ++v)
        for (int u = -5; u <= 5; ++u) {
            const auto pixel = static_cast<std::size_t>((y + v) * width + x + u);
            const double w = std::exp(-(u * u + v * v) / (2 * 1.5 * 1.5));
            total += w, mr += w * r[pixel], mi += w * i[pixel];
            rr += w * r[pixel] * r[pixel], ii += w * i[pixel] * i[pixel], ri += w * r[pixel] * i[pixel];
        }
    for (double* sum : {&mr, &mi, &rr, &ii, &ri}) *sum /= total;
    return (2 * mr * mi + 1e-4) * (2 * (ri - mr * mi) + 9e-4) /
           ((mr * mr + mi * mi + 1e-4) * (rr - mr * mr + ii - mi * mi + 9e-4));
}

TEST(Legibility, SimilarityIsThatOfThePlainFormula) {
    const auto grey = [](const pictures::Image& image) {
        std::vector<double> values(image.pixels.size());
        std::ranges::transform(image.pixels, values.begin(),
                               [](const glm::vec4& pixel) { return static_cast<double>(maths::encodeSrgb(pixel.r)); });
        return values;
    };
    const pictures::Image a = noise(3, 1), b = noise(4, 0.4f, &a);
    const std::vector<double> r = grey(a), i = grey(b);
    double sum = 0;
    for (int y = 5; y < a.height - 5; ++y)
        for (int x = 5; x < a.width - 5; ++x) sum += similarityAt(r, i, a.width, x, y);
    EXPECT_NEAR(legibility::similarity(a, b), sum / ((a.width - 10) * (a.height - 10)), 1e-6);  // floats
}

TEST(Legibility, SimilarityIsOneOfEqualPicturesAndFallsWithNoise) {
    const pictures::Image picture = noise(1, 1);
    EXPECT_NEAR(legibility::similarity(picture, picture), 1, 1e-12);
    double last = 1;
    for (const float amplitude : {0.1f, 0.3f, 0.6f, 1.0f}) {
        const double now = legibility::similarity(picture, noise(2, amplitude, &picture));
        EXPECT_LT(now, last);
        last = now;
    }
    EXPECT_NEAR(last, 0, 0.1);  // independent pictures
}

/// Raised stripes in place of letters.
scene::Panel stripes() {
    auto relief = std::make_shared<scene::Relief>();
    relief->columns = 128;
    relief->rows = 64;
    for (int row = 0; row < 64; ++row)
        for (int column = 0; column < 128; ++column) {
            const bool raised = column / 12 % 2 == 0 && row > 10 && row < 54;
            relief->depth.push_back(raised ? 0.1f : 0.6f);
            relief->colour.emplace_back(raised ? 0.05f : 0.7f);
        }
    scene::Panel panel;
    panel.name = "sign";
    panel.sizeMetres = {1.2, 0.6};
    panel.depthMetres = 0.02;
    panel.relief = relief;
    return panel;
}

TEST(Legibility, AHarderSignLastsLonger) {
    const scene::Panel panel = stripes();
    scene::Scene scene;
    const auto until = [&](double hardness) {
        return legibility::particlesUntil(0.7, draw::TestCanvas::device(), scene, panel,
                                          {.massKilograms = 0.01, .hardnessJoulesPerCubicMetre = hardness}, 1);
    };
    const double soft = until(1e4), hard = until(1e6);
    EXPECT_GT(soft, 1);
    EXPECT_GT(hard, 5 * soft);
}

TEST(ViewAngle, TheSafeMarchMissesNothingAndFewStepsMissMostWhenGrazing) {
    const scene::Panel panel = stripes();
    scene::Scene scene;
    const auto missed = [&](const ReliefStyle& style, double degrees) {
        return view_angle::seenAt(draw::TestCanvas::device(), scene, panel, style, degrees).share();
    };
    const ReliefStyle few{March::paper, 3, 5, false, false};
    for (const double degrees : {0.0, 60.0, 85.0}) EXPECT_LT(missed({}, degrees), 0.01) << degrees;
    EXPECT_GT(missed(few, 85), 0.05);
    EXPECT_GT(missed(few, 85), missed(few, 0));
}

TEST(ViewAngle, BumpMappingMissesWhatTheDepthMovesAside) {
    // At a depth of d the visible point is offset by d·tan(angle) from that on the face.
    scene::Panel panel = stripes();
    auto level = std::make_shared<scene::Relief>(*panel.relief);
    level->depth.assign(level->depth.size(), 0.5f);
    panel.relief = level;
    const double tolerance = 3 * panel.sizeMetres.x / level->columns;
    scene::Scene scene;
    const auto missedAt = [&](double degrees) {
        return view_angle::seenAt(draw::TestCanvas::device(), scene, panel, {}, degrees).bumpShare();
    };
    EXPECT_LT(missedAt(0), 0.02);
    // The picture's rim is 26° off its middle.
    const auto angleOf = [&](double times) {
        return std::atan(times * tolerance / (0.5 * panel.depthMetres)) * 180 / 3.14159265;
    };
    EXPECT_LT(missedAt(angleOf(0.2)), 0.02);
    EXPECT_GT(missedAt(angleOf(2.5)), 0.9);
}

}  // namespace
}  // namespace dustbench::relief
