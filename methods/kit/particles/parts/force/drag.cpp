// Air resistance, linear in the velocity relative to the air: a = k·(u − v).
//
// Limited to k·dt ≤ 1, so that a particle at most reaches the air's velocity in one step. This is stable at any rate,
// and the terminal velocity is g/k at any step length. The thesis mentions air resistance without a formula; this is
// Stokes' law, which holds for grains as small as dust.
#include <algorithm>

#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::force::drag {
namespace {

void resist(std::size_t count, const float* __restrict air, const float* __restrict velocity,
            float* __restrict acceleration, float rate) {
    for (std::size_t i = 0; i < count; ++i) acceleration[i] += rate * (air[i] - velocity[i]);
}

class Drag final : public ForcePart {
 public:
    explicit Drag(const ParameterValues& values);

    void push(Chunk& chunk, const Step& step) const override;

 private:
    double ratePerSecond_;
};

Drag::Drag(const ParameterValues& values) : ForcePart(values), ratePerSecond_(values.real("rate_per_second")) {}

void Drag::push(Chunk& chunk, const Step& step) const {
    const float rate = static_cast<float>(std::min(ratePerSecond_, 1 / step.seconds));
    resist(chunk.count, chunk.airX, chunk.velocityX, chunk.accelerationX, rate);
    resist(chunk.count, chunk.airY, chunk.velocityY, chunk.accelerationY, rate);
    resist(chunk.count, chunk.airZ, chunk.velocityZ, chunk.accelerationZ, rate);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "air resistance, proportional to the velocity relative to the air";
    info.source = "Thesis, 5";
    info.parameters.real("rate_per_second", 1, 0, 1e6, "1/s", "how fast particles take on the air's velocity");
    info.create = [](const ParameterValues& values) { return std::make_unique<Drag>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::drag
