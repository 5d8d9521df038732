// The kind of part that sets particles' radius, at birth and over their life.
//
// Source: Thesis, 3.1.3 and 4.5.
#pragma once

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

class SizePart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::size; }

    virtual void initialise(Chunk& chunk, const Step& step) const = 0;
    virtual void update(Chunk&, const Step&) const {}
};

}  // namespace dustbench::particles
