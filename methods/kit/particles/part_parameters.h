// Parameters that several parts declare in the same way, and what they stand for: vectors, the mode of a formula,
// speeds, opacities, pictures, meshes, and the drawing of the part itself.
//
// Units: m, m/s. Frame: world; meshes in their own. Colours: linear RGB. Threads: pure.
// Source: Thesis, 3.3.2, 4.3.1, 4.4.2 and 4.4.3, Figures 5.2, 5.5 and 6.2.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/contract/errors.h"
#include "methods/contract/parameters.h"
#include "methods/kit/maths/bezier.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"

namespace dustbench::particles {

// --- Vectors: `direction = [0, 1, 0]` in a file, declared as `direction.x`, `.y`, `.z`.

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

/// The parameter `mode` of parts whose formula in the thesis has an error.
inline constexpr Choices<maths::SamplingMode> samplingModes{{"paper", maths::SamplingMode::paper},
                                                            {"fixed", maths::SamplingMode::fixed}};

/// A speed drawn at birth: average + R·variation with R in [−1, 1). Negative speeds go backwards.
class RandomSpeed {
 public:
    static void declare(ParameterSet& set) {
        set.real("speed", 2, -1000, 1000, "m/s", "mean speed")
            .real("variation", 0, 0, 1000, "m/s", "maximum deviation from the mean");
    }
    explicit RandomSpeed(const ParameterValues& values)
        : average_(static_cast<float>(values.real("speed"))),
          variation_(static_cast<float>(values.real("variation"))) {}

    /// `u`: uniform in [0, 1).
    [[nodiscard]] float operator()(float u) const { return average_ + maths::centred(u) * variation_; }

 private:
    float average_, variation_;
};

/// Opacity α by age, the fourth component of a colour. At most 0.999, so that τ is finite.
class OpacityCurve {
 public:
    static void declare(ParameterSet& set);
    /// `mode` paper: the cubic curve with the printed weights (maths/bezier.h), limited to 0.999.
    explicit OpacityCurve(const ParameterValues& values, maths::SamplingMode mode = maths::SamplingMode::fixed);

    void write(const float* share, float* opacity, std::size_t count) const;

 private:
    enum class Form { linear, bezier };
    static constexpr Choices<Form> forms{{"linear", Form::linear}, {"bezier", Form::bezier}};

    Form form_;
    bool printed_;
    float start_, end_;
    maths::CubicPolynomial<float> curve_;
};

/// Declares `picture`, that of a sprite: a Gaussian, or a picture of data/textures.
void declarePicture(ParameterSet& set);
/// Returns the picture's name; empty for the Gaussian.
[[nodiscard]] std::string pictureOf(const ParameterValues& values);

/// Declares `mesh` (`mesh = "hare"`, or a file's path), `scale` and `open`.
void declareMesh(ParameterSet& set);
/// The mesh's triangles, scaled, that have an area. Throws InputError if the file is missing or unreadable, if no
/// triangle has an area, or if the surface has a hole and `open` is off.
[[nodiscard]] std::vector<std::array<glm::vec3, 3>> trianglesOf(const ParameterValues& values);

[[nodiscard]] inline double areaOf(const std::array<glm::vec3, 3>& triangle) {
    const glm::dvec3 a(triangle[0]), b(triangle[1]), c(triangle[2]);
    return glm::length(glm::cross(b - a, c - a)) / 2;
}

// --- The picture of a part itself: a disc, an attractor or a light, where a part is asked to show it.

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
