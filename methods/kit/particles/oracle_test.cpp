// Compares the particle engine with the reference implementation.
#include <gtest/gtest.h>

#include "methods/kit/particles/plain_dust.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

/// The values of test::everyForce, and the defaults of its parts.
const PlainDustSettings dustForces{.birthsPerSecond = 30,
                                   .birthsPerMetre = 25,
                                   .discMetres = 0.2f,
                                   .direction = {-0.5f, 0.8f, 0.1f},
                                   .halfAngleDegrees = 50,
                                   .speed = 0.5f,
                                   .speedShare = 0.15f,
                                   .speedVariation = 0.6f,
                                   .inherit = 0.2f,
                                   .lifeSeconds = 0.8f,
                                   .lifeVariationSeconds = 0.5f,
                                   .radiusAtBirth = 0.25f,
                                   .radiusGained = 1.35f,
                                   .opacity = {0.25f, 0.17f, 0.08f, 0.0f},
                                   .gravity = 1.5f,
                                   .dragPerSecond = 2.5f,
                                   .windFactor = 0.8,
                                   .gustSpeed = 0.7,
                                   .gustMetres = 3,
                                   .gustSeconds = 3,
                                   .lift = 0.3f,
                                   .frictionPerSecond = 3};

TEST(ParticleSystem, MovesParticlesAsThePlainDustDoes) {
    const auto scene = test::sceneWithCar();
    auto system = test::systemFrom(test::everyForce);
    PlainDust plain(dustForces, scene);
    std::size_t compared = 0;
    for (int i = 1; i <= 200; ++i) {
        const auto state = test::drivingStraight(i / 60.0, 18);
        system.update({scene, state, 1.0 / 60, 0});
        plain.step(state, 1.0 / 60);
        const ParticleStore& store = system.store();
        ASSERT_EQ(store.size(), plain.alive().size());
        for (std::size_t k = 0; k < store.size(); ++k) {
            ASSERT_TRUE(plain.alive().contains(store.serial[k]));
            const PlainParticle& p = plain.alive().at(store.serial[k]);
            ASSERT_LT(glm::length(store.position(k) - p.position), 2e-4f) << "step " << i << " particle " << k;
            ASSERT_NEAR(store.velocityX[k], p.velocity.x, 1e-3f);
            ASSERT_NEAR(store.velocityY[k], p.velocity.y, 1e-3f);
            ASSERT_NEAR(store.velocityZ[k], p.velocity.z, 1e-3f);
            ASSERT_NEAR(store.age[k], p.age, 1e-6f);
            ASSERT_EQ(store.lifetime[k], p.lifetime);
            ASSERT_NEAR(store.radius[k], p.radius, 1e-5f);
            ASSERT_NEAR(store.opacity[k], p.opacity, 1e-6f);
            ++compared;
        }
    }
    EXPECT_GT(compared, 50000u);
}

}  // namespace
}  // namespace dustbench::particles
