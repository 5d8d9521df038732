// A flock: separation, matching of velocities, cohesion, and a pull towards a cruising speed.
//
// The three rules: flock.h. Cruising: a = rate·(s₀ − |v|)·v/|v|. The sum is limited to a maximum, as a boid's muscles
// are. The rules use positions at the start of the step; newborns take part from the next step on.
#include "methods/contract/errors.h"
#include "methods/kit/particles/flock.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::particles::parts::force::boids {
namespace {

class Boids final : public ForcePart {
 public:
    /// Throws InputError if boids separate beyond their sight.
    explicit Boids(const ParameterValues& values);

    void begin(const Step& step, const ParticleStore& store) override;
    void push(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] std::size_t bytes() const override {
        return flock_.bytes() + accelerations_.capacity() * sizeof(glm::vec3);
    }

 private:
    FlockRules rules_;
    float cruiseSpeed_, cruiseRate_, maximum_;
    Flock flock_;
    std::vector<glm::vec3> accelerations_;  ///< of this step, in the store's order
};

Boids::Boids(const ParameterValues& values)
    : ForcePart(values),
      rules_{static_cast<float>(values.real("near_metres")), static_cast<float>(values.real("sight_metres")),
             static_cast<float>(values.real("separation")), static_cast<float>(values.real("matching")),
             static_cast<float>(values.real("cohesion"))},
      cruiseSpeed_(static_cast<float>(values.real("cruise_speed"))),
      cruiseRate_(static_cast<float>(values.real("cruise_rate"))),
      maximum_(static_cast<float>(values.real("maximum_acceleration"))) {
    if (rules_.nearMetres > rules_.sightMetres)
        throw InputError("parameter near_metres: got " + values.canonical().find("near_metres")->second +
                         ", allowed: at most sight_metres, " + values.canonical().find("sight_metres")->second);
}

void Boids::begin(const Step&, const ParticleStore& s) {
    accelerations_.resize(s.size());
    if (s.empty()) return;
    flock_.accelerate(rules_, {s.x, s.y, s.z, s.velocityX, s.velocityY, s.velocityZ}, accelerations_);
}

void Boids::push(Chunk& chunk, const Step&) const {
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const glm::vec3 v(chunk.velocityX[i], chunk.velocityY[i], chunk.velocityZ[i]);
        const float speed = glm::length(v);
        glm::vec3 a = accelerations_[chunk.first + i];
        if (speed > 0) a += cruiseRate_ * (cruiseSpeed_ / speed - 1) * v;
        const float size = glm::length(a);
        if (size > maximum_) a *= maximum_ / size;
        chunk.accelerationX[i] += a.x;
        chunk.accelerationY[i] += a.y;
        chunk.accelerationZ[i] += a.z;
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "particles flock: they separate, match their neighbours' velocity, and stay together";
    info.source = "Reynolds1987, 3; Thesis, 7.3";
    info.parameters.real("near_metres", 0.25, 1e-3, 1e4, "m", "neighbours closer than this push a boid away")
        .real("sight_metres", 0.6, 1e-3, 1e4, "m", "neighbours closer than this count for the other two rules")
        .real("separation", 0.6, 0, 1e4, "m²/s²", "s: a = s·Σ (x − x_j)/d² over the nearer ones")
        .real("matching", 2, 0, 1e3, "1/s", "m: a = m·(mean velocity − v)")
        .real("cohesion", 1, 0, 1e4, "1/s²", "c: a = c·(mean position − x)")
        .real("cruise_speed", 2, 0, 1e3, "m/s", "speed that a boid keeps where no rule applies")
        .real("cruise_rate", 1, 0, 1e3, "1/s", "how fast it returns to that speed")
        .real("maximum_acceleration", 20, 0, 1e5, "m/s²", "limit on the sum of all rules");
    info.create = [](const ParameterValues& values) { return std::make_unique<Boids>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::boids
