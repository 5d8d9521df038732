#include "methods/shared/particles/parts/random_size.h"

#include "methods/shared/errors.h"
#include "methods/shared/maths/philox.h"

namespace dustbench::particles {

PartInfo RandomSize::describe() {
    PartInfo info{PartKind::size, "random", "a radius drawn at birth and kept", {}, {}};
    info.parameters.real("average_metres", 0.5, 0, 1000, "m", "mean radius")
        .real("variation_metres", 0.25, 0, 1000, "m", "largest departure from the mean, at most the mean");
    return info;
}

RandomSize::RandomSize(const ParameterValues& values)
    : SizePart("random", values),
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

}  // namespace dustbench::particles
