// The kind of part that sets the position of newborns: the source.
//
// Source: Thesis, 3.1.3 and 4.2.
#pragma once

#include "methods/kit/particles/lattice.h"
#include "methods/kit/particles/newborns.h"
#include "methods/kit/particles/part.h"

namespace dustbench::particles {

class PositionPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::position; }

    /// The carriers of the source in this step; if empty, nothing is born. Velocity parts use them too.
    [[nodiscard]] virtual std::span<const Emitter> emitters(const Step& step) const = 0;
    /// The lattice that the particles form; null: none.
    [[nodiscard]] virtual const Lattice* lattice() const { return nullptr; }
    /// Sets positions at the moment of birth.
    virtual void place(Newborns& newborns, const Step& step) const = 0;
};

}  // namespace dustbench::particles
