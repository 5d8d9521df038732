// Three-component parameters: `direction = [0, 1, 0]` in a file, declared as `direction.x`, `.y`, `.z`.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "methods/contract/errors.h"
#include "methods/contract/parameters.h"

namespace dustbench::particles {

inline constexpr std::array<std::string_view, 3> spaceAxes{"x", "y", "z"};
inline constexpr std::array<std::string_view, 3> colourAxes{"red", "green", "blue"};

inline void declareVector(ParameterSet& set, const std::string& name, const std::array<std::string_view, 3>& axes,
                          glm::dvec3 initial, double minimum, double maximum, const std::string& unit,
                          const std::string& help) {
    for (int i = 0; i < 3; ++i)
        set.real(name + "." + std::string(axes[static_cast<std::size_t>(i)]), initial[i], minimum, maximum, unit, help);
}

[[nodiscard]] inline glm::dvec3 vectorOf(const ParameterValues& values, const std::string& name,
                                         const std::array<std::string_view, 3>& axes) {
    return {values.real(name + "." + std::string(axes[0])), values.real(name + "." + std::string(axes[1])),
            values.real(name + "." + std::string(axes[2]))};
}

/// A vector in space as a unit vector. Throws InputError for one of zero length.
[[nodiscard]] inline glm::vec3 directionOf(const ParameterValues& values, const std::string& name) {
    const glm::vec3 direction = vectorOf(values, name, spaceAxes);
    if (!(glm::length(direction) > 1e-6f))
        throw InputError("parameter " + name + ": got [0, 0, 0], allowed: a vector of non-zero length");
    return glm::normalize(direction);
}

}  // namespace dustbench::particles
