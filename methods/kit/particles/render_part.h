// The kind of part that describes the appearance of particles. Methods do the drawing.
//
// Source: Thesis, 3.1.3 and 4.1. Departs: many methods can draw one system, so the part contains no drawing code.
#pragma once

#include "methods/kit/particles/part.h"

namespace dustbench::particles {

/// The shapes that a file can request.
enum class Primitive { puff };

class RenderPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::render; }

    [[nodiscard]] virtual Primitive primitive() const = 0;
};

}  // namespace dustbench::particles
