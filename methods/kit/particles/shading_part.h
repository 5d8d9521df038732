// The kind of part that lights particles: it adds to the luminosity; the colour shown is colour · luminosity.
//
// Source: Thesis, 3.1.3 and 6.2.
#pragma once

#include <optional>

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/emitted_light.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

/// The light that a system's particles emit (emitted_light.h).
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

}  // namespace dustbench::particles
