// The engine against the slowest and clearest way to say the same: a map of particles, each updated by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "methods/shared/maths/bezier.h"
#include "methods/shared/maths/philox.h"
#include "methods/shared/maths/sampling.h"
#include "methods/shared/maths/turbulence.h"
#include "methods/shared/particles/test_world.h"

namespace dustbench::particles {
namespace {

struct Particle {
    glm::vec3 position{0}, velocity{0};
    float age = 0, lifetime = 0, radius = 0, opacity = 0;
};

/// test::everyForce, written out by hand.
class Oracle {
 public:
    explicit Oracle(const scene::Scene& scene) : scene_(scene) {}

    void step(const scene::SceneState& state, double seconds) {
        const float dt = static_cast<float>(seconds);
        for (auto& [serial, p] : alive_) p.age += dt;
        std::erase_if(alive_, [](const auto& entry) { return entry.second.age > entry.second.lifetime; });
        const glm::dvec3 wind = 0.8 * glm::dvec3(scene_.wind);
        const auto gusts = maths::gustField(0.7, 3, 3, wind, state.timeSeconds, 1, windStream);
        for (auto& [serial, p] : alive_) {
            appear(p);
            const glm::vec3 air = glm::vec3(wind) + gusts(p.position.x, p.position.y, p.position.z);
            const glm::vec3 acceleration = glm::vec3(0, -1.5f, 0) + 2.5f * (air - p.velocity);
            p.velocity += acceleration * dt;
            p.position += p.velocity * dt;
            rest(p, dt);
        }
        due_ += (30 + 25 * state.vehicle.speed) * seconds;
        while (due_ >= 1) {
            due_ -= 1;
            // What is left over of the count, `due`, is what has been lived since birth, in births.
            bear(state, due_ / (30 + 25 * state.vehicle.speed), seconds);
        }
    }
    [[nodiscard]] const std::map<std::uint64_t, Particle>& alive() const { return alive_; }

 private:
    static void appear(Particle& p) {
        const float t = std::min(p.age / p.lifetime, 1.0f);
        p.radius = 0.25f + 1.35f * t;
        p.opacity = maths::bezier(0.25f, 0.17f, 0.08f, 0.0f, t);
    }
    static void rest(Particle& p, float dt) {
        if (p.position.y >= 0.3f * p.radius) return;
        p.position.y = 0.3f * p.radius;
        p.velocity.y = std::max(p.velocity.y, 0.0f);
        p.velocity /= 1 + 3 * dt;
    }
    void bear(const scene::SceneState& state, double lived, double seconds) {
        const std::uint64_t serial = born_++;
        const auto& wheel = state.vehicle.wheels[serial % 4];
        Particle p;
        p.age = static_cast<float>(lived);
        const auto u = maths::uniform4(1, positionStream, serial), v = maths::uniform4(1, velocityStream, serial);
        const glm::vec2 disc = 0.2f * maths::discPoint(u[0], u[1]);
        p.position = glm::vec3(wheel.contact - wheel.velocity * lived) + glm::vec3(disc.x, 0, disc.y);
        const glm::vec3 axis = glm::normalize(glm::vec3(-0.5f, 0.8f, 0.1f));
        const float speed =
            (0.5f + 0.15f * static_cast<float>(state.vehicle.speed)) * (1 + 0.6f * maths::centred(v[2]));
        p.velocity = speed * maths::Cone(maths::SamplingMode::fixed, axis, 50.0f / 360).direction(v[0], v[1]) +
                     0.2f * glm::vec3(wheel.velocity);
        p.position += p.velocity * p.age;
        p.lifetime = 0.8f + 0.5f * maths::centred(maths::uniform4(1, lifeStream, serial)[0]);
        appear(p);
        rest(p, static_cast<float>(seconds));
        alive_[serial] = p;
    }

    const scene::Scene& scene_;
    std::map<std::uint64_t, Particle> alive_;
    std::uint64_t born_ = 0;
    double due_ = 0;
};

TEST(Oracle, EngineDoesAsOneParticleAtATimeDoes) {
    const auto scene = test::sceneWithCar();
    auto system = test::systemFrom(test::everyForce);
    Oracle oracle(scene);
    std::size_t compared = 0;
    for (int i = 1; i <= 200; ++i) {
        const auto state = test::drivingStraight(i / 60.0, 18);
        system.update({scene, state, 1.0 / 60, 0});
        oracle.step(state, 1.0 / 60);
        const ParticleStore& store = system.store();
        ASSERT_EQ(store.size(), oracle.alive().size());
        for (std::size_t k = 0; k < store.size(); ++k) {
            ASSERT_TRUE(oracle.alive().contains(store.serial[k]));
            const Particle& p = oracle.alive().at(store.serial[k]);
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
