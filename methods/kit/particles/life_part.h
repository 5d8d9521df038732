// The kind of part that decides whether a particle dies. Exactly one in the list sets lifetimes.
//
// Source: Thesis, 3.1.3 and 4.7.
#pragma once

#include <optional>

#include "methods/kit/particles/newborns.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/surface.h"

namespace dustbench::particles {

class LifePart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::life; }

    /// Called once per step before all chunks.
    virtual void begin(const Step&) {}
    /// Sets `chunk.dead` to 1 for particles that must die; leaves the others unchanged.
    virtual void evaluate(Chunk& chunk, const Step& step) const = 0;

    /// A surface at which particles die; null: none.
    [[nodiscard]] virtual const Surface* surface() const { return nullptr; }
    [[nodiscard]] virtual Contact contact() const { return {.kills = true}; }

    /// The mean lifetime, if this part sets lifetimes.
    [[nodiscard]] virtual std::optional<double> meanLifetimeSeconds() const { return std::nullopt; }
    /// Writes `lifetime`, with the position and velocity at birth; implemented only by parts that set lifetimes.
    virtual void giveLifetimes(Newborns&, const Step&) const {}
};

}  // namespace dustbench::particles
