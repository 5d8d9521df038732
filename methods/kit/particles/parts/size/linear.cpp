// A radius that changes linearly from birth to death.
#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::size::linear {
namespace {

void linearRadius(std::size_t count, const float* __restrict share, float* __restrict radius, float start, float end) {
    const float change = end - start;
    for (std::size_t i = 0; i < count; ++i) radius[i] = start + change * share[i];
}

class LinearSize final : public SizePart {
 public:
    explicit LinearSize(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override { update(chunk, step); }
    void update(Chunk& chunk, const Step& step) const override;

 private:
    float startMetres_, endMetres_;
};

LinearSize::LinearSize(const ParameterValues& values)
    : SizePart(values),
      startMetres_(static_cast<float>(values.real("start_metres"))),
      endMetres_(static_cast<float>(values.real("end_metres"))) {}

void LinearSize::update(Chunk& chunk, const Step&) const {
    linearRadius(chunk.count, chunk.share, chunk.radius, startMetres_, endMetres_);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "from one radius at birth to another at death";
    info.source = "Thesis, 4.5";
    info.parameters.real("start_metres", 0.25, 0, 1000, "m", "radius at birth")
        .real("end_metres", 1.6, 0, 1000, "m", "radius at death");
    info.create = [](const ParameterValues& values) { return std::make_unique<LinearSize>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::size::linear
