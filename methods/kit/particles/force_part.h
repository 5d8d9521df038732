// The kind of part that moves particles: by the air it stirs, by acceleration, or by contact.
//
// Within a step all forces first `blow`, then all `push`; the particles move; then all `touch`. So the order of the
// list matters only among forces of the same sort. Source: Thesis, 3.1.3 and 5.1.
#pragma once

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

class ForcePart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::force; }

    /// Called once a step, before all chunks: for what is the same for every particle.
    virtual void begin(const Step&) {}
    /// Adds to the air's velocity, `chunk.airX`, `…Y`, `…Z`.
    virtual void blow(Chunk&, const Step&) const {}
    /// Adds to the acceleration, which may depend on the air.
    virtual void push(Chunk&, const Step&) const {}
    /// Puts right position and velocity of what has moved through a surface; the old position is x − v·dt.
    virtual void touch(Chunk&, const Step&) const {}
};

}  // namespace dustbench::particles
