#include "bench/reference/cloud_march.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <stdexcept>

#include "bench/reference/test_clouds.h"

namespace dustbench::reference {
namespace {

using particles::ParticleStore;

/// Puffs of random colours.
ParticleStore colouredBall(MemoryLedger& ledger, std::uint64_t seed, float densest = 0.5f) {
    ParticleStore store = test::ball(ledger, seed, 60, {0, 0.5f, 0}, 3, densest);
    store.keepOneColour(false);
    for (std::size_t i = 0; i < store.size(); ++i) {
        const auto c = maths::uniform4(seed, 5, i);
        store.red[i] = c[0];
        store.green[i] = c[1];
        store.blue[i] = c[2];
    }
    return store;
}

double largestDifference(const CloudImage& a, const CloudImage& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            worst = std::max(worst, static_cast<double>(std::abs(a.image.pixels[i][c] - b.image.pixels[i][c])));
    return worst;
}

CloudImage marched(const ParticleStore& store, const scene::View& view, const OpaqueDistances& distances,
                   double slabMetres) {
    ReferenceOptions options;
    options.slabMetres = slabMetres;
    return marchParticles(store, view, distances, options);
}

TEST(CloudMarch, HasTheOpacityOfTheClosedFormWhateverTheSlabs) {
    MemoryLedger ledger;
    ParticleStore store = colouredBall(ledger, 2);
    for (const glm::dvec3 eye : {glm::dvec3(1, 2, 10), glm::dvec3(0.3, 0.5, 0.2)}) {
        const scene::View view = test::viewFrom(eye, {0, 0, -1}, 41, 31);
        const OpaqueDistances ground = test::groundDistances(view, 0);
        const auto plain = test::plainDepths(store, view, ground);
        for (const double slab : {0.05, 0.31, 100.0}) {
            const CloudImage cloud = marched(store, view, ground, slab);
            for (std::size_t i = 0; i < plain.size(); ++i)
                ASSERT_NEAR(cloud.opticalDepths[i], plain[i], 1e-6 + 4e-9 * plain[i]) << slab;
        }
    }
}

TEST(CloudMarch, IsExactForOneColour) {
    MemoryLedger ledger;
    const scene::View view = test::viewFrom({1, 2, 10}, {0, 0, 0}, 41, 31);
    const OpaqueDistances ground = test::groundDistances(view, 0);
    ParticleStore store = test::ball(ledger, 2, 60, {0, 0.5f, 0}, 3, 0.5f);
    const CloudImage one = renderParticles(store, view, ground);
    store.keepOneColour(false);
    const CloudImage own = marched(store, view, ground, 0.5);
    EXPECT_EQ(own.colourErrorBound, 0);
    EXPECT_LT(largestDifference(one, own), 1e-6);
}

TEST(CloudMarch, PuffsApartAreDrawnOneOverTheOther) {
    MemoryLedger ledger;
    ParticleStore store(ledger);
    // The farther puff comes first in the store.
    test::add(store, {0, 0, -10}, 1, 0.7f);
    test::add(store, {0, 0, 0}, 1, 0.4f);
    store.keepOneColour(false);
    store.red[0] = 1, store.green[0] = 0, store.blue[0] = 0.5f;
    store.red[1] = 0, store.green[1] = 1, store.blue[1] = 0.5f;
    const scene::View view = test::viewFrom({0, 0, 10}, {0, 0, 0}, 41, 31);
    const glm::vec4 middle = renderParticles(store, view, skyDistances(view)).image.at(20, 15);
    EXPECT_NEAR(middle.r, 0.6 * 0.7, 1e-6);
    EXPECT_NEAR(middle.g, 0.4, 1e-6);
    EXPECT_NEAR(middle.b, 0.5 * (1 - 0.6 * 0.3), 1e-6);
    EXPECT_NEAR(middle.a, 1 - 0.6 * 0.3, 1e-6);
}

TEST(CloudMarch, ConvergesAtOrderTwoAndStaysWithinItsBound) {
    MemoryLedger ledger;
    const ParticleStore store = colouredBall(ledger, 4);
    for (const glm::dvec3 eye : {glm::dvec3(1, 2, 10), glm::dvec3(0.3, 0.5, 0.2)}) {
        const scene::View view = test::viewFrom(eye, {0, 0, -1}, 41, 31);
        const OpaqueDistances ground = test::groundDistances(view, 0);
        const CloudImage finest = marched(store, view, ground, 0.00625);
        double before = 0;
        for (const double slab : {0.2, 0.1, 0.05}) {
            const CloudImage cloud = marched(store, view, ground, slab);
            const double error = largestDifference(cloud, finest);
            EXPECT_LT(error, cloud.colourErrorBound) << slab;
            EXPECT_GT(error, 1e-6) << slab;
            if (before > 0) {
                EXPECT_GT(before / error, 3) << slab;
            }
            before = error;
        }
        // The accuracy stated in cloud_march.h for the default, 0.1 m.
        EXPECT_LT(largestDifference(marched(store, view, ground, 0.1), finest), 2e-3);
    }
}

TEST(CloudMarch, EqualsABruteForceMarchOfColours) {
    MemoryLedger ledger;
    const ParticleStore store = colouredBall(ledger, 5);
    const scene::View view = test::viewFrom({1, 2, 9}, {0, 0, -1}, 15, 11);
    const OpaqueDistances ground = test::groundDistances(view, 0);
    const CloudImage cloud = marched(store, view, ground, 0.02);
    const CameraRays rays(view);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            // dL/dt = T·Σσc, dT/dt = −T·Σσ by the midpoint rule with steps of 4 mm.
            const auto pixel = static_cast<std::size_t>(y * view.width + x);
            const double end = std::min(20.0, ground.metres[pixel]);
            const int steps = static_cast<int>(end / 0.004) + 1;
            glm::dvec3 light(0);
            double depth = 0;
            for (int k = 0; k < steps; ++k) {
                const glm::dvec3 at = view.camera.eye + end * (k + 0.5) / steps * rays.direction(x, y);
                double extinction = 0;
                glm::dvec3 emission(0);
                for (std::size_t i = 0; i < store.size(); ++i) {
                    const double sigma = maths::puffExtinctionPerMetre(static_cast<double>(store.opacity[i]),
                                                                       static_cast<double>(store.radius[i]),
                                                                       glm::length(glm::dvec3(store.position(i)) - at));
                    extinction += sigma;
                    emission += sigma * glm::dvec3(store.colour(i));
                }
                light += emission * std::exp(-depth - extinction * end / steps / 2) * (end / steps);
                depth += extinction * end / steps;
            }
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(static_cast<double>(cloud.image.pixels[pixel][c]), light[c], 1e-4) << x << ' ' << y;
        }
}

TEST(LitParticles, EqualTheClosedFormsWithTheSunAlongTheRay) {
    // At the centre of the picture the ray is the axis. Sun behind the eye: light takes the same path in and out, ∫
    // e^(−2τ) dτ = ½(1 − e^(−2Σ)). Sun ahead: from any point it passes through the whole cloud, Σ·e^(−Σ).
    MemoryLedger ledger;
    ParticleStore store(ledger);
    test::add(store, {0, 0, 0.3f}, 1.2f, 0.6f);
    test::add(store, {0.2f, 0.1f, -1}, 0.9f, 0.5f);
    const scene::View view = test::viewFrom({0, 0, 12}, {0, 0, 0}, 41, 31);
    SunLight light{.toSun = {0, 0, 1}, .sun = {1, 0.9, 0.8}, .ambient = glm::dvec3(0), .albedo = glm::dvec3(0.8)};
    ReferenceOptions options;
    options.slabMetres = 0.01;
    const std::size_t middle = 15 * 41 + 20;
    const CloudImage front = renderLitParticles(store, view, skyDistances(view), light, options);
    const double depth = front.opticalDepths[middle];
    EXPECT_GT(depth, 1);
    const auto lit = [&](const CloudImage& cloud) { return static_cast<double>(cloud.image.pixels[middle].g); };
    EXPECT_NEAR(lit(front), 0.8 * 0.9 / 4 * (1 - std::exp(-2 * depth)) / 2, 2e-6);
    light.toSun = {0, 0, -1};
    const CloudImage back = renderLitParticles(store, view, skyDistances(view), light, options);
    EXPECT_NEAR(lit(back), 0.8 * 0.9 / 4 * depth * std::exp(-depth), 2e-6);
    // Ambient light alone acts like a colour.
    light.sun = glm::dvec3(0);
    light.ambient = {0.3, 0.4, 0.5};
    const CloudImage sky = renderLitParticles(store, view, skyDistances(view), light, options);
    EXPECT_NEAR(lit(sky), 0.8 * 0.4 * (1 - std::exp(-depth)), 1e-6);
}

TEST(LitParticles, ScatterByTheAngleBetweenSightAndSun) {
    // F = (1 − g²)/(1 + g² − 2g·cos)^1.5 multiplies the sunlight: for g = ½, 6 at cos = 1 and 2/9 at −1.
    MemoryLedger ledger;
    ParticleStore store(ledger);
    test::add(store, {0, 0, 0}, 1, 0.5f);
    const scene::View view = test::viewFrom({0, 0, 12}, {0, 0, 0}, 41, 31);
    SunLight light{.toSun = {0, 0, -1}, .sun = {1, 1, 1}, .ambient = glm::dvec3(0), .albedo = glm::dvec3(1)};
    const auto middle = [&] {
        return static_cast<double>(renderLitParticles(store, view, skyDistances(view), light).image.at(20, 15).g);
    };
    const double ahead = middle();
    light.toSun = {0, 0, 1};
    const double behind = middle();
    light.asymmetry = 0.5;
    EXPECT_NEAR(middle() / behind, 2.0 / 9, 1e-6);
    light.toSun = {0, 0, -1};
    EXPECT_NEAR(middle() / ahead, 6, 1e-5);
}

TEST(LitParticles, AreThoseOfTheSceneWithoutShadowAndPhase) {
    // Thin dust that scatters equally in all directions shows its own colours: SunLight::of is scene::dustLight.
    MemoryLedger ledger;
    ParticleStore store(ledger);
    test::add(store, {0, 0, 0}, 1, 1e-4f);
    store.colourOfAll = {0.75f, 0.6f, 0.45f};
    const scene::View view = test::viewFrom({0, 0, 12}, {0, 0, 0}, 41, 31);
    scene::Scene scene;
    scene.dustAsymmetry = 0;
    const glm::vec4 unlit = renderParticles(store, view, skyDistances(view)).image.at(20, 15);
    const glm::vec4 lit = renderLitParticles(store, view, skyDistances(view), SunLight::of(scene)).image.at(20, 15);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(lit[c] / unlit[c], 1, 1e-4f) << c;
    // With both, thin dust has the colour times scene::dustLight at the puff's centre.
    scene.dustAsymmetry = 0.6f;
    const float cosine = glm::dot(glm::vec3(0, 0, -1), scene.lights.toSun);
    const glm::vec4 phased = renderLitParticles(store, view, skyDistances(view), SunLight::of(scene)).image.at(20, 15);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(phased[c] / unlit[c], scene::dustLight(scene, 1, cosine)[c], 2e-4f) << c;
}

TEST(LitParticles, ConvergeAtOrderTwoAndToWhatIsPromised) {
    MemoryLedger ledger;
    ParticleStore store = test::ball(ledger, 7, 60, {0, 0.8f, 0}, 3, 0.5f);
    for (std::size_t i = 0; i < store.size(); ++i) store.radius[i] = std::max(store.radius[i], 0.5f);
    const scene::View view = test::viewFrom({1, 2, 10}, {0, 0.5, 0}, 41, 31);
    const OpaqueDistances ground = test::groundDistances(view, 0);
    const SunLight light{.toSun = {-0.93, 0.26, -0.25}, .sun = {4, 3.7, 3.2}};
    const auto render = [&](double slab) {
        ReferenceOptions options;
        options.slabMetres = slab;
        return renderLitParticles(store, view, ground, light, options);
    };
    const CloudImage finest = render(0.0125);
    const double coarse = largestDifference(render(0.2), finest), half = largestDifference(render(0.1), finest),
                 quarter = largestDifference(render(0.05), finest);
    EXPECT_GT(coarse / half, 3);
    EXPECT_GT(half / quarter, 3);
    EXPECT_GT(quarter, 1e-7);
    EXPECT_LT(largestDifference(render(0.1), render(0.05)), 1e-3);
}

TEST(LitParticles, AreDarkerAwayFromTheSunAndSameAtAnyNumberOfThreads) {
    const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
    MemoryLedger ledger;
    const ParticleStore store = test::ball(ledger, 7, 80, {0, 0, 0}, 2, 0.7f);
    const scene::View view = test::viewFrom({0, 0, 12}, {0, 0, 0}, 41, 31);
    const SunLight light{.toSun = {0, 1, 0}};
    const auto render = [&] { return renderLitParticles(store, view, skyDistances(view), light); };
    const CloudImage cloud = tbb::task_arena(1).execute(render);
    double upper = 0, lower = 0;
    for (int x = 0; x < 41; ++x) {
        upper += static_cast<double>(cloud.image.at(x, 10).r / std::max(cloud.image.at(x, 10).a, 1e-9f));
        lower += static_cast<double>(cloud.image.at(x, 20).r / std::max(cloud.image.at(x, 20).a, 1e-9f));
    }
    EXPECT_GT(upper, 1.2 * lower);
    for (const int threads : {2, 3, 8})
        EXPECT_EQ(tbb::task_arena(threads).execute(render).image.pixels, cloud.image.pixels) << threads;
}

TEST(CloudMarch, RefusesWhatDoesNotFit) {
    MemoryLedger ledger;
    ParticleStore store = colouredBall(ledger, 1);
    const scene::View view = test::viewFrom({1, 2, 10}, {0, 0, 0}, 41, 31),
                      other = test::viewFrom({1, 2, 10}, {0, 0, 0}, 40, 31);
    EXPECT_THROW(std::ignore = renderParticles(store, view, skyDistances(other)), std::invalid_argument);
    EXPECT_THROW(std::ignore = renderLitParticles(store, view, skyDistances(view), {.toSun = {0, 0, 0}}),
                 std::invalid_argument);
    EXPECT_THROW(std::ignore = renderLitParticles(store, view, skyDistances(view), {.toSun = {0, std::nan(""), 0}}),
                 std::invalid_argument);
    store.green[3] = std::nanf("");
    try {
        std::ignore = renderParticles(store, view, skyDistances(view));
        FAIL() << "a colour of NaN was taken";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("particle 103 "));
    }
}

TEST(CloudMarch, IsTransparentWithoutParticles) {
    MemoryLedger ledger;
    const scene::View view = test::viewFrom({1, 2, 10}, {0, 0, 0}, 41, 31);
    const ParticleStore none(ledger);
    for (const CloudImage& cloud :
         {marchParticles(none, view, skyDistances(view)), renderLitParticles(none, view, skyDistances(view), {})})
        for (const glm::vec4& pixel : cloud.image.pixels) ASSERT_EQ(pixel, glm::vec4(0));
}

}  // namespace
}  // namespace dustbench::reference
