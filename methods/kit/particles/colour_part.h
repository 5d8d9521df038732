// The kind of part that sets particles' colour and opacity, at birth and over their life.
//
// Source: Thesis, 3.1.3 and 4.4 (a colour has four components; the fourth is the opacity α).
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

class ColourPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::colour; }

    /// The colour shared by all particles, if there is one; colour columns are then omitted.
    [[nodiscard]] virtual std::optional<glm::vec3> colourOfAll(const Step&) const { return std::nullopt; }
    /// Writes opacity, and colour if the chunk has colours. With shading, called at every step.
    virtual void initialise(Chunk& chunk, const Step& step) const = 0;
    /// Writes the values that change with age (`chunk.share`).
    virtual void update(Chunk& chunk, const Step& step) const = 0;
};

}  // namespace dustbench::particles
