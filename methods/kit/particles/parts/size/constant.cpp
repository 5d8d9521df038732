// One constant radius for all particles.
#include <algorithm>

#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::size::constant {
namespace {

class ConstantSize final : public SizePart {
 public:
    explicit ConstantSize(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override;

 private:
    float radiusMetres_;
};

ConstantSize::ConstantSize(const ParameterValues& values)
    : SizePart(values), radiusMetres_(static_cast<float>(values.real("radius_metres"))) {}

void ConstantSize::initialise(Chunk& chunk, const Step&) const {
    std::fill_n(chunk.radius, chunk.count, radiusMetres_);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "one constant radius for all particles";
    info.source = "Thesis, 4.5";
    info.parameters.real("radius_metres", 0.5, 0, 1000, "m", "radius");
    info.create = [](const ParameterValues& values) { return std::make_unique<ConstantSize>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::size::constant
