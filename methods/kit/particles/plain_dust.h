// Reference implementation of a dust cloud, one particle at a time; tests compare the chunked update with it.
//
//     age ← age + Δt                        dead where age > lifetime
//     a = −g + k·(u − v)                    u: the air's velocity, wind and gusts
//     v ← v + a·Δt,  x ← x + v·Δt
//
// Units: m, s, kg. Frame: world. Ground: flat. Source: Thesis, 3.3.2 (order of the update) and 5.1 (semi-implicit
// Euler); Reeves1983, 2 (births, motion, death).
#pragma once

#include <cstdint>
#include <map>

#include "methods/contract/scene.h"

namespace dustbench::particles {

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

}  // namespace dustbench::particles
