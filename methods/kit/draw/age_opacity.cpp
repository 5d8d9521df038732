#include "methods/kit/draw/age_opacity.h"

namespace dustbench::draw {

void declareOpacity(ParameterSet& parameters) {
    parameters
        .choice("opacity", OpacityFrom::dust, opacityOrigins,
                "opacity of a particle: the dust's own, or from age alone as in the paper")
        .real("young_opacity", 0.5, 0, 0.999, "", "opacity at birth, with opacity=age; it falls linearly to 0");
}

std::span<const float> AgeOpacity::of(const Puffs& dust) {
    column_.resize(dust.size());
    for (std::size_t i = 0; i < dust.size(); ++i) column_[i] = opacityByAge(dust.age[i], dust.lifetime[i], young_);
    return column_;
}

}  // namespace dustbench::draw
