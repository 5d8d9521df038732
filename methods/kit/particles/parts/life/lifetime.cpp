// Death by age. The lifetime is set at birth, from chance, speed and place:
//
//     average + R·variation + a·(|v| − v₀) + g·(x − x₀),   R in [−1, 1), at least 0.01 s
#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::life::lifetime {
namespace {

constexpr double leastSeconds = 0.01;

void raiseWhereOld(std::size_t count, const float* __restrict age, const float* __restrict lifetime,
                   std::uint8_t* __restrict dead) {
    for (std::size_t i = 0; i < count; ++i) dead[i] = age[i] > lifetime[i] ? std::uint8_t{1} : dead[i];
}

class Lifetime final : public LifePart {
 public:
    /// Throws InputError if a lifetime could be 0.
    explicit Lifetime(const ParameterValues& values);

    void evaluate(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] std::optional<double> meanLifetimeSeconds() const override { return averageSeconds_; }
    void giveLifetimes(Newborns& newborns, const Step& step) const override;

 private:
    double averageSeconds_, variationSeconds_;
    float perSpeed_, meanSpeed_;
    glm::vec3 perMetre_, meanPlace_;
};

Lifetime::Lifetime(const ParameterValues& values)
    : LifePart(values),
      averageSeconds_(values.real("average_seconds")),
      variationSeconds_(values.real("variation_seconds")),
      perSpeed_(static_cast<float>(values.real("per_speed"))),
      meanSpeed_(static_cast<float>(values.real("mean_speed"))),
      perMetre_(vectorOf(values, "per_metre", spaceAxes)),
      meanPlace_(vectorOf(values, "mean_place", spaceAxes)) {
    if (variationSeconds_ >= averageSeconds_)
        throw InputError("parameter variation_seconds: got " + values.canonical().find("variation_seconds")->second +
                         ", allowed: less than average_seconds, " + values.canonical().find("average_seconds")->second);
}

void Lifetime::evaluate(Chunk& chunk, const Step&) const {
    raiseWhereOld(chunk.count, chunk.age, chunk.lifetime, chunk.dead);
}

void Lifetime::giveLifetimes(Newborns& newborns, const Step& step) const {
    const Chunk& chunk = newborns.chunk;
    const float average = static_cast<float>(averageSeconds_), variation = static_cast<float>(variationSeconds_);
    for (std::size_t i = 0; i < chunk.count; ++i)
        chunk.lifetime[i] =
            average + variation * maths::centred(maths::uniform4(step.seed, lifeStream, chunk.serial[i])[0]);
    if (perSpeed_ == 0 && perMetre_ == glm::vec3(0)) return;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const glm::vec3 x(chunk.x[i], chunk.y[i], chunk.z[i]);
        const glm::vec3 v(chunk.velocityX[i], chunk.velocityY[i], chunk.velocityZ[i]);
        const float more = perSpeed_ * (glm::length(v) - meanSpeed_) + glm::dot(perMetre_, x - meanPlace_);
        chunk.lifetime[i] = std::max(chunk.lifetime[i] + more, static_cast<float>(leastSeconds));
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "death by age, after a time set at birth: by chance, speed and place";
    info.source = "Thesis, 4.7.2";
    info.parameters
        .real("average_seconds", 4, leastSeconds, 1e6, "s",
              "mean lifetime; `particles=N` relies on it, so that mean_speed and mean_place should be true means")
        .real("variation_seconds", 1, 0, 1e6, "s", "maximum deviation from the mean, less than the mean")
        .real("per_speed", 0, -1e6, 1e6, "s²/m", "longer lifetime for each m/s at birth above mean_speed")
        .real("mean_speed", 0, 0, 1e6, "m/s", "speed at birth with the mean lifetime");
    declareVector(info.parameters, "per_metre", spaceAxes, {0, 0, 0}, -1e6, 1e6, "s/m",
                  "longer lifetime for each metre of the birthplace from mean_place along an axis of the world");
    declareVector(info.parameters, "mean_place", spaceAxes, {0, 0, 0}, -1e6, 1e6, "m",
                  "birthplace with the mean lifetime");
    info.create = [](const ParameterValues& values) { return std::make_unique<Lifetime>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::life::lifetime
