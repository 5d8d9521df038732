// The kind of part that says what a particle looks like. It describes; drawing is the methods' affair.
//
// Source: Thesis, 3.1.3 and 4.1. Departs: one system can be drawn by many methods, so the part holds no drawing code.
#pragma once

#include "methods/kit/particles/part.h"

namespace dustbench::particles {

/// The shapes that a file may ask for.
enum class Primitive { puff };

class RenderPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::render; }

    [[nodiscard]] virtual Primitive primitive() const = 0;
};

}  // namespace dustbench::particles
