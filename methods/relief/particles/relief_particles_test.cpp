#include "methods/relief/particles/relief_particles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "methods/kit/meshes/curved_panel.h"
#include "methods/relief/surface/surface_hit.h"

namespace dustbench::relief {
namespace {

scene::Panel panelOf(double width, double height, double depth, int columns, int rows, float share, unsigned seed = 0) {
    auto relief = std::make_shared<scene::Relief>();
    relief->columns = columns;
    relief->rows = rows;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> any(0, 1);
    for (int i = 0; i < columns * rows; ++i) relief->depth.push_back(seed == 0 ? share : any(random));
    relief->colour.assign(relief->depth.size(), glm::vec3(0.5f));
    scene::Panel panel;
    panel.sizeMetres = {width, height};
    panel.depthMetres = depth;
    panel.relief = relief;
    return panel;
}

class ReliefParticlesTest : public testing::Test {
 protected:
    MemoryLedger ledger_;
};

TEST_F(ReliefParticlesTest, TheFixedLawIsTheParabolaAtAnyStep) {
    const scene::Panel panel = panelOf(100, 100, 50, 2, 2, 1);
    const DepthMap surface(*panel.relief, ledger_);
    for (const int steps : {1, 7, 60}) {
        ReliefParticles particles(panel, ledger_);
        const glm::vec3 place(1, 2, -3), velocity(0.5f, 3, -1.5f), gravity(0, -9.8f, 0.3f);
        particles.add({place, velocity}, {}, 1);
        const float dt = 1.0f / static_cast<float>(steps);
        for (int k = 0; k < steps; ++k) particles.step(surface, {MotionLaw::fixed, gravity, dt, 1000});
        ASSERT_EQ(particles.size(), 1u);
        const glm::vec3 expected = place + velocity + 0.5f * gravity;
        EXPECT_LT(glm::distance(glm::vec3(particles.places()[0]), expected), 2e-5f) << steps;
        EXPECT_LT(glm::distance(glm::vec3(particles.velocities()[0]), velocity + gravity), 2e-5f);
        EXPECT_EQ(particles.places()[0].w, static_cast<float>(steps));
    }
}

// Seen from the panel's frame, a particle in a curved relief flies the same parabola.
TEST_F(ReliefParticlesTest, ACurvedReliefDoesNotBendPaths) {
    struct Case {
        glm::dvec2 bend;
        double startX, speedX;  // the face comes closer on the way
    };
    for (const auto& [bend, startX, speedX] :
         {Case{{1, 0}, 0.5, -0.9}, Case{{-0.8, 0}, 0.2, 0.9}, Case{{0.6, -0.7}, 0.5, -0.9}}) {
        scene::Panel panel = panelOf(1.6, 1.6, 0.2, 2, 2, 1);
        panel.curvaturePerMetre = bend;
        const DepthMap surface(*panel.relief, ledger_);
        const DepthPyramid pyramid(surface, ledger_);
        for (const DepthPyramid* skip : {static_cast<const DepthPyramid*>(nullptr), &pyramid}) {
            ReliefParticles particles(panel, ledger_);
            const glm::dvec3 start(startX, 0.3, -0.02), velocity(speedX, 0.4, -0.05), gravity(0.2, -1, 0.05);
            particles.add({glm::vec3(start), glm::vec3(glm::inverse(meshes::reliefAxes(panel, start)) * velocity)}, {},
                          1);
            for (int k = 0; k < 20; ++k)
                particles.step(surface, {MotionLaw::fixed, glm::vec3(gravity), 1.0f / 60, 1000, skip});
            ASSERT_EQ(particles.size(), 1u);
            const double t = 20.0 / 60;
            const glm::dvec3 expected = meshes::fromRelief(panel, start) + velocity * t + 0.5 * t * t * gravity;
            const glm::dvec3 place(particles.places()[0]);
            EXPECT_LT(glm::distance(meshes::fromRelief(panel, place), expected), 1e-5);
            const glm::dvec3 now = meshes::reliefAxes(panel, place) * glm::dvec3(particles.velocities()[0]);
            EXPECT_LT(glm::distance(now, velocity + t * gravity), 1e-5);
        }
    }
}

// With the age as T and P₀, V₀ rewritten, V after n steps is n!·V₀ + (n! + n!/1! + n!/2! + … + n!/(n−1)!)·gΔt.
TEST_F(ReliefParticlesTest, ThePapersLawCompounds) {
    const scene::Panel panel = panelOf(1e6, 1e6, 1e6, 2, 2, 1);
    const DepthMap surface(*panel.relief, ledger_);
    ReliefParticles particles(panel, ledger_);
    particles.add({{0, 0, -1e5f}, {1, 0, 0}}, {}, 1);
    const float dt = 1.0f / 64, g = 8;
    double velocity = 1, fall = 0;
    for (int n = 1; n <= 6; ++n) {
        particles.step(surface, {MotionLaw::paper, {0, -g, 0}, dt, 1000});
        velocity *= n;
        fall = n * (fall - static_cast<double>(g * dt));
        EXPECT_FLOAT_EQ(particles.velocities()[0].x, static_cast<float>(velocity));
        EXPECT_FLOAT_EQ(particles.velocities()[0].y, static_cast<float>(fall));
    }
    EXPECT_EQ(velocity, 720);
}

// R24: gravity lowers the green channel, y, in each step.
TEST_F(ReliefParticlesTest, GravityLowersGreenEachStepUnderBothLaws) {
    const scene::Panel panel = panelOf(1000, 1000, 100, 2, 2, 1);
    const DepthMap surface(*panel.relief, ledger_);
    for (const MotionLaw law : {MotionLaw::paper, MotionLaw::fixed}) {
        ReliefParticles particles(panel, ledger_);
        for (int i = 0; i < 100; ++i)
            particles.add({{0.1f * static_cast<float>(i), 0, -50}, {0, 0, 0}}, {}, static_cast<std::uint64_t>(i));
        std::vector<float> before(100, 0);
        for (int step = 0; step < 5; ++step) {
            particles.step(surface, {law, {0, -9.8f, 0}, 1.0f / 60, 1000});
            ASSERT_EQ(particles.size(), 100u);
            for (std::size_t i = 0; i < 100; ++i) {
                EXPECT_LT(particles.places()[i].y, before[i]);
                before[i] = particles.places()[i].y;
            }
        }
    }
}

TEST_F(ReliefParticlesTest, NothingTunnelsAtAnySpeed) {
    const scene::Panel panel = panelOf(1, 1, 0.05, 64, 64, 0, 3);
    const DepthMap surface(*panel.relief, ledger_);
    std::mt19937 random(11);
    std::normal_distribution<float> gauss;
    std::uniform_real_distribution<float> share(-0.5f, 0.5f);
    ReliefParticles particles(panel, ledger_);
    std::size_t downwards = 0;
    for (int i = 0; i < 20'000; ++i) {
        const float speed = std::pow(10.0f, static_cast<float>(i % 6));  // 1 m/s … 100 km/s
        particles.add({{0.2f * share(random), 0.2f * share(random), 0},
                       {0.01f * speed * gauss(random), 0.01f * speed * gauss(random), -speed}},
                      {}, static_cast<std::uint64_t>(i));
        ++downwards;
    }
    for (int step = 0; step < 10 && particles.size() > 0; ++step) {
        particles.step(surface, {MotionLaw::fixed, {0, 0, 0}, 1.0f / 60, 1000});
        for (const SurfaceHit& hit : particles.hits()) {
            const double depth = surface.depthAt(static_cast<double>(hit.texels.x), static_cast<double>(hit.texels.y));
            // Positions are floats of up to half a metre: 3e-8 m, 6e-7 of the depth; slopes reach 64 per texel of 1/64
            // m.
            ASSERT_NEAR(static_cast<double>(hit.texels.z), depth, 2e-5);
        }
        downwards -= particles.hits().size();
    }
    EXPECT_EQ(downwards, 0u);  // all of them fly within 20 cm of the middle, so each one hits
}

// Speeds from a thousandth of a texel to a hundred plates per step, with particles near the surface, far from it and
// along the rim.
TEST_F(ReliefParticlesTest, ThePyramidChangesNothingButTheTime) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const scene::Panel panel = panelOf(1.7, 0.9, 0.2, 53, 38, 0, seed);
        const DepthMap surface(*panel.relief, ledger_);
        const DepthPyramid pyramid(surface, ledger_);
        ReliefParticles slow(panel, ledger_), quick(panel, ledger_);
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> any(-1, 1);
        for (std::uint64_t n = 0; n < 40'000; ++n) {
            const float speed = std::pow(10.0f, 3 * any(random));
            const Motion motion{{0.85f * any(random), 0.45f * any(random), -0.01f * std::abs(any(random))},
                                speed * glm::vec3(any(random), any(random), 0.3f * any(random))};
            slow.add(motion, {}, n);
            quick.add(motion, {}, n);
        }
        for (int step = 0; step < 8; ++step) {
            StepSettings settings{.gravity = {0.1f, -9.8f, -1}, .maximumAgeSteps = 8};
            slow.step(surface, settings);
            settings.pyramid = &pyramid;
            quick.step(surface, settings);
            ASSERT_EQ(slow.hits().size(), quick.hits().size()) << step;
            for (std::size_t i = 0; i < slow.hits().size(); ++i)
                ASSERT_EQ(slow.hits()[i].texels, quick.hits()[i].texels);
            ASSERT_TRUE(std::ranges::equal(slow.places(), quick.places())) << step;
            ASSERT_TRUE(std::ranges::equal(slow.velocities(), quick.velocities()));
        }
    }
}

TEST_F(ReliefParticlesTest, LeavesByTheRimAndByTheFaceAndDiesOfAge) {
    const scene::Panel panel = panelOf(2, 2, 0.1, 4, 4, 1);
    const DepthMap surface(*panel.relief, ledger_);
    ReliefParticles particles(panel, ledger_);
    particles.add({{0.95f, 0, -0.05f}, {10, 0, 0}}, {}, 1);  // over the rim
    particles.add({{0, 0, -0.05f}, {0, 0, 10}}, {}, 2);      // back through the face
    particles.add({{0, 0, -0.05f}, {0, 0, 0}}, {}, 3);       // stays
    particles.step(surface, {MotionLaw::fixed, {0, 0, 0}, 1.0f / 60, 3});
    EXPECT_EQ(particles.size(), 1u);
    EXPECT_TRUE(particles.hits().empty());
    particles.step(surface, {MotionLaw::fixed, {0, 0, 0}, 1.0f / 60, 3});
    EXPECT_EQ(particles.size(), 1u);
    particles.step(surface, {MotionLaw::fixed, {0, 0, 0}, 1.0f / 60, 3});
    EXPECT_EQ(particles.size(), 0u);
}

TEST_F(ReliefParticlesTest, ARampsNormalIsThatOfItsPlane) {
    auto relief = std::make_shared<scene::Relief>();
    relief->columns = 11;
    relief->rows = 11;
    for (int row = 0; row < 11; ++row)
        for (int column = 0; column < 11; ++column) relief->depth.push_back(static_cast<float>(column) / 10);
    scene::Panel panel;
    panel.sizeMetres = {11, 11};  // a texel a metre: the depth grows by 0.1·5 m a metre
    panel.depthMetres = 5;
    panel.relief = relief;
    const DepthMap surface(*relief, ledger_);
    ReliefParticles particles(panel, ledger_);
    particles.add({{0, 0, 0}, {0, 0, -1000}}, {}, 1);
    particles.step(surface, {MotionLaw::fixed, {0, 0, 0}, 1, 3});
    ASSERT_EQ(particles.hits().size(), 1u);
    const SurfaceHit& hit = particles.hits()[0];
    EXPECT_LT(glm::distance(hit.normal, glm::normalize(glm::vec3(0.5f, 0, 1))), 1e-6f);
    EXPECT_NEAR(hit.texels.x, 5, 1e-5);
    EXPECT_NEAR(hit.texels.z, 0.5, 1e-5);
}

}  // namespace
}  // namespace dustbench::relief
