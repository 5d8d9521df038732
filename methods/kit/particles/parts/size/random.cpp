// A constant radius drawn at birth: average + R·variation with R in [−1, 1).
#include "methods/contract/errors.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::size::random {
namespace {

class RandomSize final : public SizePart {
 public:
    /// Throws InputError if a radius could fall below 0.
    explicit RandomSize(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override;

 private:
    float averageMetres_, variationMetres_;
};

RandomSize::RandomSize(const ParameterValues& values)
    : SizePart(values),
      averageMetres_(static_cast<float>(values.real("average_metres"))),
      variationMetres_(static_cast<float>(values.real("variation_metres"))) {
    if (variationMetres_ > averageMetres_)
        throw InputError("parameter variation_metres: got " + values.canonical().find("variation_metres")->second +
                         ", allowed: at most average_metres, " + values.canonical().find("average_metres")->second);
}

void RandomSize::initialise(Chunk& chunk, const Step& step) const {
    for (std::size_t i = 0; i < chunk.count; ++i)
        chunk.radius[i] = averageMetres_ +
                          variationMetres_ * maths::centred(maths::uniform4(step.seed, sizeStream, chunk.serial[i])[0]);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a radius drawn at birth and kept";
    info.source = "Thesis, 4.5";
    info.parameters.real("average_metres", 0.5, 0, 1000, "m", "mean radius")
        .real("variation_metres", 0.25, 0, 1000, "m", "maximum deviation from the mean, at most the mean");
    info.create = [](const ParameterValues& values) { return std::make_unique<RandomSize>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::size::random
