// The kind of part that moves particles: through the air it stirs, by acceleration, or by contact.
//
// Within a step all forces first `blow`, then all `push`; the particles move; then all `touch`. The order of the list
// therefore matters only among forces of the same sort. Source: Thesis, 3.1.3 and 5.1.
#pragma once

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

class ForcePart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::force; }

    /// Called once per step before all chunks, to compute values shared by all particles.
    virtual void begin(const Step&) {}
    /// Adds to the air's velocity, `chunk.airX`, `…Y`, `…Z`.
    virtual void blow(Chunk&, const Step&) const {}
    /// Adds to the acceleration, which may depend on the air's velocity.
    virtual void push(Chunk&, const Step&) const {}
    /// Corrects position and velocity of particles that have moved through a surface; the old position is x − v·dt.
    virtual void touch(Chunk&, const Step&) const {}
};

}  // namespace dustbench::particles
