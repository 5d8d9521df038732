// The kind of part that gives newborns their position: the source.
//
// Source: Thesis, 3.1.3 and 4.2.
#pragma once

#include "methods/kit/particles/newborns.h"
#include "methods/kit/particles/part.h"

namespace dustbench::particles {

class PositionPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::position; }

    /// What carries the source in this step; nothing is born where there is none. Velocity parts see it too.
    [[nodiscard]] virtual std::span<const Emitter> emitters(const Step& step) const = 0;
    /// Positions at the moment of birth.
    virtual void place(Newborns& newborns, const Step& step) const = 0;
};

}  // namespace dustbench::particles
