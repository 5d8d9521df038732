#include "methods/kit/particles/placed_source.h"

#include "methods/kit/particles/vector_parameter.h"

namespace dustbench::particles {

void PlacedSource::declare(ParameterSet& set) {
    set.choice("at", At::wheels, places, "at the contact points of the vehicle's wheels, or at `place`");
    declareVector(set, "place", spaceAxes, {0, 0, 0}, -1e6, 1e6, "m", "position in the world, if at = place");
}

PlacedSource::PlacedSource(const ParameterValues& values) : PositionPart(values), at_(values.choice("at", places)) {
    place_.from = place_.to = vectorOf(values, "place", spaceAxes);
}

std::span<const Emitter> PlacedSource::emitters(const Step& step) const {
    return at_ == At::wheels ? step.wheels : std::span(&place_, 1);
}

}  // namespace dustbench::particles
