// Compares the particle engine with a reference implementation of a dust cloud, one particle at a time.
//
//     age ← age + Δt                        dead where age > lifetime
//     a = −g + k·(u − v)                    u: the air's velocity, wind and gusts
//     v ← v + a·Δt,  x ← x + v·Δt
//
// Units: m, s, kg. Frame: world. Ground: flat. Source: Thesis, 3.3.2 (order of the update) and 5.1 (semi-implicit
// Euler); Reeves1983, 2 (births, motion, death).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "methods/contract/scene.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/maths/turbulence.h"
#include "methods/kit/particles/step.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

/// Parameters of the parts, by their names.
struct PlainDustSettings {
    std::uint64_t seed = 1;
    double birthsPerSecond = 0, birthsPerMetre = 0;  ///< stream
    float discMetres = 0;                            ///< disc
    glm::vec3 direction{0, 1, 0};                    ///< cone
    float halfAngleDegrees = 0, speed = 0, speedShare = 0, speedVariation = 0, inherit = 0;
    float lifeSeconds = 0, lifeVariationSeconds = 0;  ///< lifetime
    float radiusAtBirth = 0, radiusGained = 0;        ///< linear
    float opacity[4]{};                               ///< bezier: its control points
    float gravity = 0;                                ///< m/s²
    float dragPerSecond = 0;
    double windFactor = 1, gustSpeed = 0, gustMetres = 4, gustSeconds = 3;
    float lift = 0, frictionPerSecond = 0;  ///< ground
};

struct PlainParticle {
    glm::vec3 position{0}, velocity{0};
    float age = 0, lifetime = 0, radius = 0, opacity = 0;
};

class PlainDust {
 public:
    /// `scene` must outlive it.
    PlainDust(const PlainDustSettings& settings, const scene::Scene& scene) : set_(settings), scene_(scene) {}

    void step(const scene::SceneState& state, double seconds);
    /// The living particles by serial.
    [[nodiscard]] const std::map<std::uint64_t, PlainParticle>& alive() const { return alive_; }

 private:
    void move(const scene::SceneState& state, float dt);
    void bear(const scene::SceneState& state, double lived, float dt);
    void appear(PlainParticle& p) const;
    void touchGround(PlainParticle& p, float dt) const;

    PlainDustSettings set_;
    const scene::Scene& scene_;
    std::map<std::uint64_t, PlainParticle> alive_;
    std::uint64_t born_ = 0;
    double due_ = 0;  ///< births that are due
};

void PlainDust::step(const scene::SceneState& state, double seconds) {
    const float dt = static_cast<float>(seconds);
    for (auto& [serial, p] : alive_) p.age += dt;
    std::erase_if(alive_, [](const auto& entry) { return entry.second.age > entry.second.lifetime; });
    move(state, dt);
    const double rate = set_.birthsPerSecond + set_.birthsPerMetre * state.vehicle.speed;
    due_ += rate * seconds;
    while (due_ >= 1) {
        due_ -= 1;
        bear(state, due_ / rate, dt);  // the remainder of the count gives the time since birth
    }
}

void PlainDust::move(const scene::SceneState& state, float dt) {
    const glm::dvec3 wind = set_.windFactor * glm::dvec3(scene_.wind);
    const maths::GustField gusts = maths::gustField(set_.gustSpeed, set_.gustMetres, set_.gustSeconds, wind,
                                                    state.timeSeconds, set_.seed, windStream);
    for (auto& [serial, p] : alive_) {
        appear(p);
        const glm::vec3 air = glm::vec3(wind) + gusts(p.position.x, p.position.y, p.position.z);
        const glm::vec3 acceleration = glm::vec3(0, -set_.gravity, 0) + set_.dragPerSecond * (air - p.velocity);
        p.velocity += acceleration * dt;
        p.position += p.velocity * dt;
        touchGround(p, dt);
    }
}

void PlainDust::bear(const scene::SceneState& state, double lived, float dt) {
    const std::uint64_t serial = born_++;
    const scene::WheelState& wheel = state.vehicle.wheels[serial % 4];
    const auto u = maths::uniform4(set_.seed, positionStream, serial);
    const auto v = maths::uniform4(set_.seed, velocityStream, serial);
    const auto l = maths::uniform4(set_.seed, lifeStream, serial);

    PlainParticle p;
    p.age = static_cast<float>(lived);
    const glm::vec2 disc = set_.discMetres * maths::discPoint(u[0], u[1]);
    p.position = glm::vec3(wheel.contact - wheel.velocity * lived) + glm::vec3(disc.x, 0, disc.y);
    const maths::Cone cone(maths::SamplingMode::fixed, glm::normalize(set_.direction), set_.halfAngleDegrees / 360);
    const float speed = (set_.speed + set_.speedShare * static_cast<float>(state.vehicle.speed)) *
                        (1 + set_.speedVariation * maths::centred(v[2]));
    p.velocity = speed * cone.direction(v[0], v[1]) + set_.inherit * glm::vec3(wheel.velocity);
    p.position += p.velocity * p.age;
    p.lifetime = set_.lifeSeconds + set_.lifeVariationSeconds * maths::centred(l[0]);
    appear(p);
    touchGround(p, dt);
    alive_[serial] = p;
}

void PlainDust::appear(PlainParticle& p) const {
    const float t = std::min(p.age / p.lifetime, 1.0f), s = 1 - t;
    p.radius = set_.radiusAtBirth + set_.radiusGained * t;
    p.opacity = s * s * s * set_.opacity[0] + 3 * s * s * t * set_.opacity[1] + 3 * s * t * t * set_.opacity[2] +
                t * t * t * set_.opacity[3];
}

void PlainDust::touchGround(PlainParticle& p, float dt) const {
    if (p.position.y >= set_.lift * p.radius) return;
    p.position.y = set_.lift * p.radius;
    p.velocity.y = std::max(p.velocity.y, 0.0f);
    p.velocity /= 1 + set_.frictionPerSecond * dt;
}

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
