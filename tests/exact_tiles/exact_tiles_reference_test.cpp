// The method exact_tiles against the ground truth of the metrics: two implementations of one formula without shared
// code.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/reference/particle_image.h"
#include "methods/contract/method.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench {

namespace exact_tiles {
MethodInfo describe();
}

namespace {

struct Case {
    std::uint64_t seed;
    std::size_t puffs;
    int width, height;
    glm::dvec3 eye, along;
    double groundBelow;  ///< 0: none
};

class Dust : public TestMoment {
 public:
    explicit Dust(const Case& one) : TestMoment(one.puffs, one.width, one.height, one.eye, one.along) {
        for (std::size_t i = 0; i < one.puffs; ++i) {
            const auto a = maths::uniform4(one.seed, 1, i), b = maths::uniform4(one.seed, 2, i);
            dust.serial[i] = i;
            dust.x[i] = 30 * maths::centred(a[0]);
            dust.y[i] = 3 * a[1];
            dust.z[i] = 30 * maths::centred(a[2]);
            dust.radius[i] = 0.25f + 1.35f * b[0];
            dust.opacity[i] = 0.25f * b[1];
        }
        dust.colourOfAll = {0.75f, 0.6f, 0.45f};
        if (one.groundBelow > 0) setGround(one.groundBelow);
    }
};

std::vector<Case> cases() {
    return {
        {1, 1'000, 320, 240, {0, 2, 20}, {0, -0.2, -1}, 2},
        {2, 1'000, 203, 101, {3, 1.5, 4}, {-1, 0.05, -0.4}, 1.5},  // within the cloud
        {3, 300, 64, 200, {0, 30, 0.5}, {0, -1, 0}, 30},           // from above, along `up`
        {4, 20'000, 160, 120, {100, 5, 0}, {-1, -0.04, 0}, 0},     // far away, no ground
        {5, 1, 40, 30, {29, 2, 2}, {-1, 0, 0}, 0},
    };
}

/// The largest difference of a channel.
double difference(const Case& one, bool oneColour,
                  const std::vector<std::pair<std::string, std::string>>& values = {}) {
    Dust dust(one);
    dust.dust.keepOneColour(oneColour);
    if (!oneColour)
        for (std::size_t i = 0; i < one.puffs; ++i) {
            const auto b = maths::uniform4(one.seed, 2, i);
            dust.dust.red[i] = b[2], dust.dust.green[i] = b[3], dust.dust.blue[i] = 1 - b[2];
        }
    const MethodInfo info = exact_tiles::describe();
    ParameterValues parameters(info.parameters);
    for (const auto& [name, value] : values) parameters.set(name, value);
    const auto method = info.create(parameters);
    method->prepare(dust.scene, {}, Dust::device());
    const pictures::Image image = dust.updateAndDraw(*method);

    const std::vector<float> rows = dust.layer().sceneDepth().readFloats();
    std::vector<float> depth;  // from the top
    for (int y = one.height - 1; y >= 0; --y)
        depth.insert(depth.end(), rows.begin() + y * one.width, rows.begin() + (y + 1) * one.width);
    reference::ReferenceOptions options;
    options.slabMetres = 0.05;
    const reference::CloudImage exact =
        reference::renderParticles(dust.dust, dust.view, reference::distancesFromDepth(dust.view, depth), options);
    double largest = 0, alpha = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        alpha = std::max(alpha, static_cast<double>(image.pixels[i].a));
        for (int c = 0; c < 4; ++c)
            largest = std::max(largest, std::abs(static_cast<double>(image.pixels[i][c]) -
                                                 static_cast<double>(exact.image.pixels[i][c])));
    }
    EXPECT_GT(alpha, one.puffs > 1 ? 0.1 : 1e-4);
    return largest;
}

TEST(ExactTilesAndReference, GiveTheSamePicture) {
    for (const Case& one : cases()) EXPECT_LT(difference(one, true), 1e-5) << one.seed;
}

TEST(ExactTilesAndReference, GiveTheSamePictureOfSeveralColours) {
    for (const Case& one : cases()) {
        if (one.puffs > 1'000) continue;  // the reference takes minutes
        EXPECT_LT(difference(one, false, {{"slab", "0.2"}}), 2e-5) << one.seed;
        EXPECT_LT(difference(one, false), 1e-4) << one.seed;
    }
}

}  // namespace
}  // namespace dustbench
