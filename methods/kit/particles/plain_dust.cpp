#include "methods/kit/particles/plain_dust.h"

#include <algorithm>
#include <cmath>

#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/maths/turbulence.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

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

}  // namespace dustbench::particles
