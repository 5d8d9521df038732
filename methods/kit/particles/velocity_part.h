// The kind of part that sets the velocity of newborns.
//
// Source: Thesis, 3.1.3 and 4.3.
#pragma once

#include "methods/kit/particles/newborns.h"
#include "methods/kit/particles/part.h"

namespace dustbench::particles {

class VelocityPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::velocity; }

    /// Called after positions have been set.
    virtual void launch(Newborns& newborns, const Step& step) const = 0;
};

}  // namespace dustbench::particles
