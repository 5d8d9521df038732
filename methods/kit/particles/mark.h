// The picture of a part itself: a disc, an attractor or a light, where a part is asked to show it.
//
// Units: m. Frame: world. Colours: linear RGB. Source: Thesis, 3.3.2 and Figures 5.2, 5.5 and 6.2.
#pragma once

#include <optional>

#include "methods/kit/particles/vector_parameter.h"

namespace dustbench::particles {

enum class MarkShape { disc, ball, cross };

struct Mark {
    MarkShape shape;
    glm::vec3 place;
    glm::vec3 normal{0, 1, 0};  ///< of a disc, unit
    float radiusMetres = 0.15f;
    glm::vec3 colour{1};
};

/// Declares `drawn` and `drawn_colour`.
inline void declareMark(ParameterSet& set, const std::string& as, const glm::dvec3& colour) {
    set.boolean("drawn", false, "draws the part itself, " + as);
    declareVector(set, "drawn_colour", colourAxes, colour, 0, 100, "", "linear RGB of that drawing");
}

/// `mark` in the colour chosen, if the part is to be drawn.
[[nodiscard]] inline std::optional<Mark> markOf(const ParameterValues& values, Mark mark) {
    if (!values.boolean("drawn")) return std::nullopt;
    mark.colour = vectorOf(values, "drawn_colour", colourAxes);
    return mark;
}

}  // namespace dustbench::particles
