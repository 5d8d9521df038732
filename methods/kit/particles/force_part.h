// The kind of part that moves particles: through moving air, by acceleration, or by contact.
//
// In each step all forces first `blow`, then all `push`. The particles move, as far as surfaces allow; then all forces
// `touch`. One force may `settle` particles that depend on each other before that. The order of the list therefore
// matters only among forces of the same type. Source: Thesis, 3.1.3 and 5.1.
#pragma once

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/step.h"
#include "methods/kit/particles/surface.h"

namespace dustbench::particles {

class MetSurfaces;
class ParticleStore;

/// Positions and velocities at the start of a step, in the order of the store.
struct StepStart {
    std::span<const float> x, y, z;
    std::span<const float> velocityX, velocityY, velocityZ;
};

/// What `settle` notes of contacts with surfaces.
struct Fates {
    std::span<std::uint8_t> dead;      ///< by particle: 1 if it dies there, otherwise unchanged
    std::span<std::vector<Hit>> hits;  ///< by chunk; empty: nobody watches them
};

class ForcePart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::force; }

    /// Called once per step before all chunks, to compute values shared by all particles, or from all of them. The
    /// store contains the particles at the start of the step and must not be read later in the step.
    virtual void begin(const Step&, const ParticleStore&) {}
    /// Adds to the air's velocity, `chunk.airX`, `…Y`, `…Z`.
    virtual void blow(Chunk&, const Step&) const {}
    /// Adds to the acceleration, which may depend on the air's velocity.
    virtual void push(Chunk&, const Step&) const {}
    /// Corrects position and velocity of particles that have moved through a surface; the old position is x − v·dt.
    virtual void touch(Chunk&, const Step&) const {}

    /// True: after all particles have moved as if there were no surfaces, `settle` determines where they end, from the
    /// start of the step, without passing surfaces. A system has at most one such part.
    [[nodiscard]] virtual bool settles() const { return false; }
    virtual void settle(ParticleStore&, const StepStart&, const Fates&, const MetSurfaces&, const Step&) {}

    /// The surface that particles cannot pass, applied between `push` and `touch`; null: none.
    [[nodiscard]] virtual const Surface* surface() const { return nullptr; }
    [[nodiscard]] virtual Contact contact() const { return {}; }

    /// Memory allocated in addition to the part object.
    [[nodiscard]] virtual std::size_t bytes() const { return 0; }
};

}  // namespace dustbench::particles
