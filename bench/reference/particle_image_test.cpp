#include "bench/reference/particle_image.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "bench/reference/test_clouds.h"

namespace dustbench::reference {
namespace {

using particles::ParticleStore;

struct Case {
    std::string name;
    scene::View view;
    ParticleStore store;
    OpaqueDistances distances;
};

/// Five random scenes: sky only; camera inside the cloud; puffs half in the ground; both, looking down; thick puffs
/// around a camera among walls.
std::vector<Case> fiveScenes(MemoryLedger& ledger) {
    std::vector<Case> cases;
    const auto far = test::viewFrom({2, 3, 14}, {0, 1, 0});
    cases.push_back({"sky", far, test::ball(ledger, 1, 40, {0, 1, 0}, 4, 0.5f), skyDistances(far)});
    const auto within = test::viewFrom({0.2, 1.1, -0.3}, {5, 1, 3});
    cases.push_back({"within", within, test::ball(ledger, 2, 40, {0, 1, 0}, 3, 0.8f), skyDistances(within)});
    const auto low = test::viewFrom({-9, 1.5, 6}, {0, 0.2, 0});
    cases.push_back(
        {"half in the ground", low, test::ball(ledger, 3, 40, {0, 0, 0}, 4, 0.6f), test::groundDistances(low, 0)});
    const auto down = test::viewFrom({0, 1.2, 0}, {0.3, 0, -0.2});
    cases.push_back({"within, over the ground", down, test::ball(ledger, 4, 60, {0, 0.2f, 0}, 2, 0.95f),
                     test::groundDistances(down, 0)});
    const auto walled = test::viewFrom({0, 0, 0}, {-1, 0.2, 0.4});
    Case last{"walls", walled, test::ball(ledger, 5, 30, {0, 0, 0}, 8, 0.999f), skyDistances(walled)};
    for (std::size_t i = 0; i < last.distances.metres.size(); ++i)
        last.distances.metres[i] = 9 * static_cast<double>(maths::uniform4(6, 1, i)[0]);
    cases.push_back(std::move(last));
    return cases;
}

double largest(const std::vector<double>& values) {
    return *std::max_element(values.begin(), values.end());
}

TEST(ParticleImage, EqualsTheBruteForceMarchInEveryPixelOfFiveScenes) {
    MemoryLedger ledger;
    for (const Case& test : fiveScenes(ledger)) {
        const CloudImage cloud = renderParticles(test.store, test.view, test.distances);
        const auto marched = test::marchedDepths(test.store, test.view, test.distances);
        double worst = 0;
        for (std::size_t i = 0; i < marched.size(); ++i)
            worst = std::max(worst, std::abs(std::expm1(-marched[i]) - std::expm1(-cloud.opticalDepths[i])));
        EXPECT_LT(worst, 1e-6) << test.name;
        RecordProperty("worst alpha error, " + test.name, fmt::format("{:.1e}", worst));
        EXPECT_GT(-std::expm1(-largest(marched)), 0.5) << test.name;
    }
}

TEST(ParticleImage, EqualsTheClosedFormPuffByPuff) {
    MemoryLedger ledger;
    for (const Case& test : fiveScenes(ledger))
        for (const double share : {1.0, 1.0 / 64}) {
            ReferenceOptions options;
            options.opticalDepthShare = share;
            const CloudImage cloud = renderParticles(test.store, test.view, test.distances, options);
            const auto plain = test::plainDepths(test.store, test.view, test.distances, share);
            for (std::size_t i = 0; i < plain.size(); ++i) {
                // Below it by at most the tolerated depth, and off by rounding.
                ASSERT_LE(plain[i] - cloud.opticalDepths[i], options.toleratedDepth + 4e-9 * plain[i]) << test.name;
                ASSERT_LE(cloud.opticalDepths[i] - plain[i], 1e-8 * (1 + plain[i])) << test.name;
            }
        }
}

TEST(ParticleImage, ColourIsTheCloudsTimesAlpha) {
    MemoryLedger ledger;
    for (const Case& test : fiveScenes(ledger)) {
        const CloudImage cloud = renderParticles(test.store, test.view, test.distances);
        EXPECT_EQ(cloud.colourErrorBound, 0);
        ASSERT_EQ(cloud.image.pixels.size(), cloud.opticalDepths.size());
        for (int y = 0; y < cloud.image.height; ++y)
            for (int x = 0; x < cloud.image.width; ++x) {
                const glm::vec4 pixel = cloud.image.at(x, y);
                const double alpha = cloud.alpha(x, y);
                ASSERT_EQ(pixel.a, static_cast<float>(alpha));
                for (int c = 0; c < 3; ++c)
                    ASSERT_EQ(pixel[c], static_cast<float>(static_cast<double>(test.store.colourOfAll[c]) * alpha));
            }
    }
}

TEST(ParticleImage, IsTheSameBitForBitAtAnyNumberOfThreads) {
    const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
    MemoryLedger ledger;
    const ParticleStore store = test::trail(ledger, 3000, 40);
    const scene::View view = test::viewFrom({6.8, 2.5, 9.4}, {-4.2, 1.2, 0}, 163, 121);
    const OpaqueDistances ground = test::groundDistances(view, 0);
    const CloudImage expected = tbb::task_arena(1).execute([&] { return renderParticles(store, view, ground); });
    EXPECT_GT(largest(expected.opticalDepths), 0.5);
    for (const int threads : {2, 3, 8}) {
        const CloudImage cloud = tbb::task_arena(threads).execute([&] { return renderParticles(store, view, ground); });
        EXPECT_EQ(cloud.opticalDepths, expected.opticalDepths) << threads;
        EXPECT_EQ(cloud.image.pixels, expected.image.pixels) << threads;
        EXPECT_EQ(cloud.evaluations, expected.evaluations) << threads;
    }
}

// ∫ Σ dΩ over all directions is mass/d², to the second order in s/d.
TEST(ParticleImage, HoldsThePuffsMass) {
    MemoryLedger ledger;
    ParticleStore store(ledger);
    test::add(store, {0, 0, 0}, 1, 0.3f);
    constexpr double distance = 25;
    const scene::View view = test::viewFrom({0, 0, distance}, {1.1, -0.4, 0}, 200, 150);
    const CameraRays rays(view);
    const CloudImage cloud = renderParticles(store, view, skyDistances(view));
    double sum = 0;
    const double pixelArea = (rays.columnSlope(1) - rays.columnSlope(0)) * (rays.rowSlope(0) - rays.rowSlope(1));
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double square = 1 + std::pow(rays.columnSlope(x), 2) + std::pow(rays.rowSlope(y), 2);
            const double solidAngle = pixelArea / (square * std::sqrt(square));
            sum += cloud.opticalDepths[static_cast<std::size_t>(y * view.width + x)] * solidAngle;
        }
    const double opacity = static_cast<double>(store.opacity[0]);
    EXPECT_NEAR(sum * distance * distance / maths::puffMassSquareMetres(opacity, 1), 1, 1e-3);
}

TEST(ParticleImage, SeesHalfOfAPuffFromItsCentreAndNothingOfOneBehind) {
    MemoryLedger ledger;
    ParticleStore store(ledger);
    test::add(store, {0, 0, 0}, 2, 0.5f);
    const scene::View from = test::viewFrom({0, 0, 0}, {0, 0, -1});
    for (const double depth : renderParticles(store, from, skyDistances(from)).opticalDepths)
        EXPECT_NEAR(depth, std::log(2) / 2, 1e-9);
    const scene::View away = test::viewFrom({0, 0, -8}, {0, 0, -9});
    for (const double depth : renderParticles(store, away, skyDistances(away)).opticalDepths) EXPECT_LT(depth, 1e-9);
    // One s in front of the eye and looking away: ½·erfc(1/√2) in the middle.
    const scene::View near = test::viewFrom({0, 0, -1}, {0, 0, -9}, 45, 35);
    EXPECT_NEAR(renderParticles(store, near, skyDistances(near)).opticalDepths[17 * 45 + 22],
                std::log(2) * std::erfc(std::numbers::sqrt2 / 2) / 2, 1e-8);
}

TEST(ParticleImage, EndsAtTheSceneUnlessItIsIgnored) {
    MemoryLedger ledger;
    const ParticleStore store = test::ball(ledger, 9, 60, {0, 0, 0}, 3, 0.4f);
    const scene::View view = test::viewFrom({0, 1, 12}, {0, 0, 0});
    OpaqueDistances distances = skyDistances(view);
    const CloudImage free = renderParticles(store, view, distances);
    std::fill(distances.metres.begin(), distances.metres.end(), 0.0);
    EXPECT_LT(largest(renderParticles(store, view, distances).opticalDepths), 1e-12);
    ReferenceOptions options;
    options.ignoreScene = true;
    EXPECT_EQ(renderParticles(store, view, distances, options).opticalDepths, free.opticalDepths);
}

TEST(ParticleImage, IsTransparentWithoutParticles) {
    MemoryLedger ledger;
    const scene::View view = test::viewFrom({0, 1, 12}, {0, 0, 0});
    const CloudImage cloud = renderParticles(ParticleStore(ledger), view, skyDistances(view));
    ASSERT_EQ(cloud.image.pixels.size(), 26u * 19);
    for (const glm::vec4& pixel : cloud.image.pixels) EXPECT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(cloud.evaluations, 0);
}

TEST(ParticleImage, TakesAnyWidthAndPuffsSmallerThanAPixel) {
    MemoryLedger ledger;
    ParticleStore store = test::ball(ledger, 8, 50, {0, 0, 0}, 3, 0.4f);
    for (std::size_t i = 0; i < store.size(); i += 2) store.radius[i] = 1e-6f;
    for (const int width : {1, 7, 8, 9, 65}) {
        const scene::View view = test::viewFrom({0, 1, 12}, {0, 0, 0}, width, 5);
        const auto depths = renderParticles(store, view, skyDistances(view)).opticalDepths;
        const auto plain = test::plainDepths(store, view, skyDistances(view));
        for (std::size_t i = 0; i < plain.size(); ++i) ASSERT_NEAR(depths[i], plain[i], 1e-6) << width;
    }
}

TEST(ParticleImage, RefusesWhatDoesNotFit) {
    MemoryLedger ledger;
    ParticleStore store = test::ball(ledger, 9, 10, {0, 0, 0}, 3, 0.4f);
    const scene::View view = test::viewFrom({0, 1, 12}, {0, 0, 0}),
                      other = test::viewFrom({0, 1, 12}, {0, 0, 0}, 27, 19);
    const auto render = [&](const OpaqueDistances& distances, const ReferenceOptions& options = {}) {
        std::ignore = renderParticles(store, view, distances, options);
    };
    EXPECT_THROW(render(skyDistances(other)), std::invalid_argument);
    for (const double share : {0.0, -1.0, 1.5, std::nan("")})
        EXPECT_THROW(render(skyDistances(view), {.opticalDepthShare = share}), std::invalid_argument) << share;
    for (const double depth : {0.0, 2.0, std::nan("")})
        EXPECT_THROW(render(skyDistances(view), {.toleratedDepth = depth}), std::invalid_argument) << depth;
    for (const double slab : {0.0, -1.0, HUGE_VAL, std::nan("")})
        EXPECT_THROW(render(skyDistances(view), {.slabMetres = slab}), std::invalid_argument) << slab;
    store.opacity[3] = std::nanf("");
    EXPECT_THROW(render(skyDistances(view)), std::runtime_error);
}

}  // namespace
}  // namespace dustbench::reference
