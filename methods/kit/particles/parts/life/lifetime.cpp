// Death by age. The lifetime is drawn at birth: average + R·variation with R in [−1, 1).
#include "methods/contract/errors.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/life_part.h"

namespace dustbench::particles::parts::life::lifetime {
namespace {

void raiseWhereOld(std::size_t count, const float* __restrict age, const float* __restrict lifetime,
                   std::uint8_t* __restrict dead) {
    for (std::size_t i = 0; i < count; ++i) dead[i] = age[i] > lifetime[i] ? std::uint8_t{1} : dead[i];
}

class Lifetime final : public LifePart {
 public:
    /// Throws InputError if a lifetime could be 0.
    explicit Lifetime(const ParameterValues& values);

    void judge(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] std::optional<double> meanLifetimeSeconds() const override { return averageSeconds_; }
    void giveLifetimes(Newborns& newborns, const Step& step) const override;

 private:
    double averageSeconds_, variationSeconds_;
};

Lifetime::Lifetime(const ParameterValues& values)
    : LifePart(values),
      averageSeconds_(values.real("average_seconds")),
      variationSeconds_(values.real("variation_seconds")) {
    if (variationSeconds_ >= averageSeconds_)
        throw InputError("parameter variation_seconds: got " + values.canonical().find("variation_seconds")->second +
                         ", allowed: less than average_seconds, " + values.canonical().find("average_seconds")->second);
}

void Lifetime::judge(Chunk& chunk, const Step&) const {
    raiseWhereOld(chunk.count, chunk.age, chunk.lifetime, chunk.dead);
}

void Lifetime::giveLifetimes(Newborns& newborns, const Step& step) const {
    const Chunk& chunk = newborns.chunk;
    const float average = static_cast<float>(averageSeconds_), variation = static_cast<float>(variationSeconds_);
    for (std::size_t i = 0; i < chunk.count; ++i)
        chunk.lifetime[i] =
            average + variation * maths::centred(maths::uniform4(step.seed, lifeStream, chunk.serial[i])[0]);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "death by age, after a time drawn at birth";
    info.source = "Thesis, 4.7.2";
    info.parameters.real("average_seconds", 4, 0.01, 1e6, "s", "mean lifetime")
        .real("variation_seconds", 1, 0, 1e6, "s", "maximum deviation from the mean, less than the mean");
    info.create = [](const ParameterValues& values) { return std::make_unique<Lifetime>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::life::lifetime
