// What a part of each kind does: births, positions, velocities, colours, sizes, lifetimes and forces. Kinds with more
// than an interface have a file of their own: render_part.h, shading_part.h and events.h.
//
// In each step all forces first `blow`, then all `push`. The particles move, as far as surfaces allow; then all forces
// `touch`. One force may `settle` particles that depend on each other before that. The order of the list therefore
// matters only among forces of the same type.
//
// Source: Thesis, 3.1.3, 4.2 to 4.7 and 5.1.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/contacts.h"
#include "methods/kit/particles/lattice.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/part_parameters.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

class ParticleStore;

/// Birth k of a step happens at firstSeconds + k·spacingSeconds after the step begins.
struct Births {
    std::int64_t count = 0;
    double firstSeconds = 0;
    double spacingSeconds = 0;
};

/// How many particles are born in a step, and when.
class EmissionPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::emission; }

    /// Called once per step; `step.particlesPerPuff` multiplies every rate. May keep state for the next step (an
    /// accumulator, a time counter).
    [[nodiscard]] virtual Births births(const Step& step) = 0;
    /// Without a vehicle, at the emission's own rate. Used to estimate the memory needed.
    [[nodiscard]] virtual double meanRatePerSecond() const { return 0; }
    /// True if the emission's own rate is 0 at any speed.
    [[nodiscard]] virtual bool neverEmits() const { return false; }
};

/// The position of newborns: the source.
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

/// Base of sources that are at the vehicle's wheels, or at a fixed position in the world.
class PlacedSource : public PositionPart {
 public:
    static void declare(ParameterSet& set) {
        set.choice("at", At::wheels, places, "at the contact points of the vehicle's wheels, or at `place`");
        declareVector(set, "place", spaceAxes, {0, 0, 0}, -1e6, 1e6, "m", "position in the world, if at = place");
    }
    explicit PlacedSource(const ParameterValues& values) : PositionPart(values), at_(values.choice("at", places)) {
        place_.from = place_.to = vectorOf(values, "place", spaceAxes);
    }

    [[nodiscard]] std::span<const Emitter> emitters(const Step& step) const override {
        return at_ == At::wheels ? step.wheels : std::span(&place_, 1);
    }

 private:
    enum class At { wheels, place };
    static constexpr Choices<At> places{{"wheels", At::wheels}, {"place", At::place}};

    At at_;
    Emitter place_;
};

/// The velocity of newborns.
class VelocityPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::velocity; }

    /// Called after positions have been set.
    virtual void launch(Newborns& newborns, const Step& step) const = 0;
};

/// Colour and opacity, at birth and over life.
class ColourPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::colour; }

    /// The colour shared by all particles, if there is one; colour columns are then omitted.
    [[nodiscard]] virtual std::optional<glm::vec3> colourOfAll(const Step&) const { return std::nullopt; }
    /// Writes opacity, and colour if the chunk has colours. With shading, called at every step.
    virtual void initialise(Chunk& chunk, const Step& step) const = 0;
    /// Writes the values that change with age (`chunk.share`).
    virtual void update(Chunk& chunk, const Step& step) const = 0;
};

/// The radius, at birth and over life.
class SizePart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::size; }

    virtual void initialise(Chunk& chunk, const Step& step) const = 0;
    virtual void update(Chunk&, const Step&) const {}
};

/// Whether a particle dies. Exactly one part in the list sets lifetimes.
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

/// What moves particles: moving air, acceleration, or contact.
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
