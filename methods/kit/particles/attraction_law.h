// Laws of attraction, a = k·f(d)·r/d towards a point at r, softened.
//
// The thesis's laws are infinite at d = 0, and 1/log d also at d = 1. Here s = √(d² + ε²) replaces d (Plummer1911): the
// attraction is largest near d = ε, and 0 at the point itself, where its direction is undefined. 1/log d is evaluated
// at 1 + s, which has no pole at 1 and no change of sign. As printed, it is limited to ±20, which it reaches where
// |log s| < 0.05.
//
// Units: m; k in m/s² times what f needs. Threads: pure. Source: Thesis, 5.2.2.
#pragma once

#include <cmath>

#include "methods/contract/choices.h"
#include "methods/kit/maths/logarithm.h"

namespace dustbench::particles {

enum class AttractionLaw { linear, inverse, inverseSquare, inverseCube, inverseRoot, inverseLog, printedLog };

inline constexpr Choices<AttractionLaw> attractionLaws{{"d", AttractionLaw::linear},
                                                       {"1/d", AttractionLaw::inverse},
                                                       {"1/d2", AttractionLaw::inverseSquare},
                                                       {"1/d3", AttractionLaw::inverseCube},
                                                       {"1/sqrt_d", AttractionLaw::inverseRoot},
                                                       {"1/log_1+d", AttractionLaw::inverseLog},
                                                       {"1/log_d", AttractionLaw::printedLog}};

inline constexpr const char* attractionLawHelp =
    "of the distance d, softened to √(d² + ε²); 1/log_1+d: the logarithm without its pole at 1 m; 1/log_d: as printed, "
    "repels within 1 m, limited to ±20";

/// Returns f(s)/s from s²; its product with r is the attraction.
template <AttractionLaw law>
[[nodiscard]] inline float pullPerMetre(float s2) {
    if constexpr (law == AttractionLaw::linear) return 1.0f;
    if constexpr (law == AttractionLaw::inverse) return 1.0f / s2;
    if constexpr (law == AttractionLaw::inverseSquare) return 1.0f / (s2 * std::sqrt(s2));
    if constexpr (law == AttractionLaw::inverseCube) return 1.0f / (s2 * s2);
    const float s = std::sqrt(s2);
    if constexpr (law == AttractionLaw::inverseRoot) return 1.0f / (s * std::sqrt(s));
    if constexpr (law == AttractionLaw::inverseLog) return 1.0f / (s * maths::naturalLogarithm(1.0f + s));
    const float logarithm = maths::naturalLogarithm(s);
    const float size = std::fabs(logarithm);
    return 1.0f / (s * std::copysign(size > 0.05f ? size : 0.05f, logarithm));
}

/// Calls `action.template operator()<law>()` for the law chosen at run time.
template <typename Action>
void withLaw(AttractionLaw law, const Action& action) {
    switch (law) {
        case AttractionLaw::linear:
            return action.template operator()<AttractionLaw::linear>();
        case AttractionLaw::inverse:
            return action.template operator()<AttractionLaw::inverse>();
        case AttractionLaw::inverseSquare:
            return action.template operator()<AttractionLaw::inverseSquare>();
        case AttractionLaw::inverseCube:
            return action.template operator()<AttractionLaw::inverseCube>();
        case AttractionLaw::inverseRoot:
            return action.template operator()<AttractionLaw::inverseRoot>();
        case AttractionLaw::inverseLog:
            return action.template operator()<AttractionLaw::inverseLog>();
        case AttractionLaw::printedLog:
            return action.template operator()<AttractionLaw::printedLog>();
    }
}

}  // namespace dustbench::particles
