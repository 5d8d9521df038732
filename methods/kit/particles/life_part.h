// The kind of part that decides whether a particle goes on living. One of the list gives the lifetimes.
//
// Source: Thesis, 3.1.3 and 4.7.
#pragma once

#include <optional>

#include "methods/kit/particles/newborns.h"
#include "methods/kit/particles/part.h"

namespace dustbench::particles {

class LifePart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::life; }

    /// Sets `chunk.dead` to 1 for the particles that must die, and leaves the others as they are.
    virtual void judge(Chunk& chunk, const Step& step) const = 0;

    /// The mean lifetime, of the one part that gives lifetimes.
    [[nodiscard]] virtual std::optional<double> meanLifetimeSeconds() const { return std::nullopt; }
    /// Writes `lifetime`: of that part alone.
    virtual void giveLifetimes(Newborns&, const Step&) const {}
};

}  // namespace dustbench::particles
