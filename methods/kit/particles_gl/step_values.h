// The numbers of one step of particles on the GPU: the parameters of its parts, the emitters and the births, as the
// shaders' uniform block `Step` (step.glsl).
//
// Units: SI. Frame: world. Threads: pure.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "methods/kit/particles/part_list.h"

namespace dustbench::particles {

inline constexpr std::size_t maximumEmitters = 4, maximumForces = 16;

/// Laid out as `Step` by the rules of std140.
struct StepValues {
    glm::uvec4 key{0};
    glm::uvec4 numbers{0};
    glm::uvec4 kinds{0};
    glm::dvec2 births{0}, seconds{0};
    glm::vec4 radius{0}, opacity{0}, life{0};
    glm::vec4 colours[2]{};
    glm::vec4 colourCurves[3]{};
    glm::vec4 source{0}, launch{0}, cone{0};
    glm::vec4 coneFrame[3]{};
    glm::vec4 from[maximumEmitters]{}, to[maximumEmitters]{}, velocityFrom[maximumEmitters]{},
        velocityTo[maximumEmitters]{}, forward[maximumEmitters]{}, up[maximumEmitters]{}, right[maximumEmitters]{};
    glm::vec4 sourceFirst[maximumEmitters]{}, sourceSecond[maximumEmitters]{};
    glm::vec4 ground{0};
    glm::ivec4 samples{0};
    glm::vec4 forces[4 * maximumForces]{};
};

/// The first part without a shader, as `the part force 'boids'`; empty if all have one.
[[nodiscard]] DUSTBENCH_API std::string partWithoutShader(const PartList& parts);
/// Whether particles have their own colours.
[[nodiscard]] bool ownColours(const PartList& parts);
/// The longest lifetime of a particle.
[[nodiscard]] double longestLifeSeconds(const PartList& parts);

/// The values of a step in which `births` of `emitters` begin with serial `firstSerial`. All parts have shaders.
[[nodiscard]] StepValues stepValues(const PartList& parts, const Step& step, const Births& births,
                                    std::span<const Emitter> emitters, std::uint64_t firstSerial);

}  // namespace dustbench::particles
