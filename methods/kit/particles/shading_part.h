// Light: the kind of part that lights particles, and the light that particles cast on the scene.
//
// A part adds to the luminosity; the colour shown is colour · luminosity. The light that particles emit, such as that
// of a fire, is approximated by a few point lights:
//
//     colour = k·Σ C·α·size³
//     position = Σ x·L / Σ L,   L = (R + G + B)·α·size³
//
// The particles are divided into groups with one light each: by age (if the wind bends a fire, the young particles
// light from its base and the old ones from its tip), by place along the longest edge of their bounding box, or by
// luminosity, each into equal intervals.
//
// Units: m; colours linear RGB in m², the intensity that scene::PointLight takes. Frame: world. Threads: pure; sums are
// in storage order, in double precision. Source: Thesis, 3.1.3, 6.2 and 6.3.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/contract/volume.h"
#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

/// What the groups have in common.
enum class GlowBy { age, place, luminosity };
inline constexpr Choices<GlowBy> glowWords{
    {"age", GlowBy::age}, {"place", GlowBy::place}, {"luminosity", GlowBy::luminosity}};

/// The light that a system's particles emit: how it is approximated.
struct Glow {
    int lights;      ///< number of groups
    float perMetre;  ///< the thesis's constant k
    GlowBy by = GlowBy::age;
};

class ShadingPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::shading; }

    /// Adds to `chunk.luminosityRed`, `…Green`, `…Blue`.
    virtual void shade(Chunk& chunk, const Step& step) const = 0;

    /// The light that the particles cast on the scene; empty: none.
    [[nodiscard]] virtual std::optional<Glow> glow() const { return std::nullopt; }
};

struct EmittedLight {
    glm::vec3 colour{0};
    glm::vec3 position{0};  ///< unspecified if the colour is 0
};

/// Returns `parts` lights: the youngest particles first, those at the smallest coordinate, or the dimmest. A particle
/// belongs to light floor(parts·s), where s is age/lifetime, the share of the way along the longest edge, or L/max L;
/// the last light includes s = 1. `perMetre`: the thesis's constant k. Throws std::invalid_argument if `parts` is below
/// one.
[[nodiscard]] DUSTBENCH_API std::vector<EmittedLight> emittedLights(const Puffs& puffs, int parts, float perMetre,
                                                                    GlowBy by = GlowBy::age);

}  // namespace dustbench::particles
