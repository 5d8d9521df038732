// Death on contact with a surface, at once or after a delay.
//
// fixed: dies at the end of the path that hits the surface (contacts.h). paper: dies if the surface lies between the
// current position and the predicted one, x + v·dt, before the forces of the step act.
// A delay ends the lifetime early: lifetime ← min(lifetime, age at the contact + delay). Until then, the particle has
// the contacts of a bounce; as printed, it flies on.
#include <algorithm>

#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"
#include "methods/kit/particles/surface_shapes.h"

namespace dustbench::particles::parts::life::collision {
namespace {

void predict(std::size_t count, const float* __restrict position, const float* __restrict velocity,
             float* __restrict next, float seconds) {
    for (std::size_t i = 0; i < count; ++i) next[i] = position[i] + velocity[i] * seconds;
}

void raiseWhereMet(std::size_t count, const float* __restrict share, std::uint8_t* __restrict dead) {
    for (std::size_t i = 0; i < count; ++i) dead[i] = share[i] <= 1.0f ? std::uint8_t{1} : dead[i];
}

void shortenWhereMet(std::size_t count, const float* __restrict share, const float* __restrict age,
                     float* __restrict lifetime, float delay) {
    for (std::size_t i = 0; i < count; ++i) {
        const float ends = share[i] <= 1.0f ? age[i] + delay : lifetime[i];
        lifetime[i] = ends < lifetime[i] ? ends : lifetime[i];
    }
}

class Collision final : public LifePart {
 public:
    /// Throws InputError if the surface cannot be used.
    explicit Collision(const ParameterValues& values)
        : LifePart(values),
          printed_(values.choice("mode", samplingModes) == maths::SamplingMode::paper),
          surface_(makeSurface(values)),
          contact_{static_cast<float>(values.real("restitution")), static_cast<float>(values.real("friction")), true,
                   static_cast<float>(values.real("delay_seconds"))} {}

    void begin(const Step& step) override { surface_->begin(step); }
    void evaluate(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] const Surface* surface() const override { return printed_ ? nullptr : surface_.get(); }
    [[nodiscard]] Contact contact() const override { return contact_; }
    [[nodiscard]] std::optional<Mark> mark() const override { return markOfSurface(values()); }

 private:
    bool printed_;
    std::unique_ptr<Surface> surface_;
    Contact contact_;
};

void Collision::evaluate(Chunk& chunk, const Step& step) const {
    if (!printed_) return;
    alignas(64) float x[chunkSize], y[chunkSize], z[chunkSize], share[chunkSize], seconds[chunkSize];
    const float dt = static_cast<float>(step.seconds);
    std::fill_n(seconds, chunk.count, dt);
    predict(chunk.count, chunk.x, chunk.velocityX, x, dt);
    predict(chunk.count, chunk.y, chunk.velocityY, y, dt);
    predict(chunk.count, chunk.z, chunk.velocityZ, z, dt);
    surface_->meet({chunk.count, chunk.x, chunk.y, chunk.z, x, y, z, seconds}, share);
    if (contact_.delaySeconds > 0)
        shortenWhereMet(chunk.count, share, chunk.age, chunk.lifetime, contact_.delaySeconds);
    else
        raiseWhereMet(chunk.count, share, chunk.dead);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "death on contact with a half-space, sphere, disc, mesh or the scene, in addition to death by age";
    info.source = "Thesis, 4.7.3 and 6.1";
    info.parameters.choice("mode", maths::SamplingMode::fixed, samplingModes,
                           "paper: tests the path predicted before the forces act; fixed: the actual path");
    declareSurface(info.parameters);
    info.parameters
        .real("delay_seconds", 0, 0, 1e6, "s",
              "from the first contact to death: the lifetime ends then, and what depends on it follows; 0: at once")
        .real("restitution", 0, 0, 1, "", "during the delay: share of the speed into the surface that is kept")
        .real("friction", 1, 0, 1, "", "during the delay: share of the speed along the surface that is lost");
    info.create = [](const ParameterValues& values) { return std::make_unique<Collision>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::life::collision
