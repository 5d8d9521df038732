// Surfaces that particles may hit during a step, and the motion of those that do: each continues from the first contact
// with its new velocity for the rest of the step, until there is no further contact.
//
// Units: m, m/s, s. Frame: world. Threads: const members are safe from any; functions are pure except for the chunk
// passed in. Source: Thesis, 5.3.2 and 6.1. Departs: the path from the old to the new position is tested as a segment,
// so that no speed is too high, and the particle bounces at the point of contact; the thesis tests positions, and
// particles restart from their previous one.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

class PartList;

/// The straight paths of `count` particles, which end together: at the end of the step, or of a part of it.
struct Ways {
    std::size_t count;
    const float *fromX, *fromY, *fromZ;
    const float *toX, *toY, *toZ;
    const float* seconds;   ///< duration of each
    float leftSeconds = 0;  ///< from the end of all paths to the end of the step

    [[nodiscard]] glm::vec3 from(std::size_t i) const { return {fromX[i], fromY[i], fromZ[i]}; }
    [[nodiscard]] glm::vec3 to(std::size_t i) const { return {toX[i], toY[i], toZ[i]}; }
};

/// The velocity after a contact: v ← (1 − friction)·v∥ − restitution·v⊥.
struct Contact {
    float restitution = 1;
    float friction = 0;
    bool kills = false;      ///< the particle dies
    float delaySeconds = 0;  ///< from the contact to that death, which becomes the end of its lifetime
};

/// One path, and its share at which it hits a surface.
struct Meeting {
    glm::vec3 from, to;
    float seconds;
    float share;
    float leftSeconds = 0;  ///< from the end of the path to the end of the step

    [[nodiscard]] glm::vec3 point() const { return from + share * (to - from); }
};

/// Where a particle touches a surface.
struct Touch {
    glm::vec3 point;
    glm::vec3 normal;       ///< unit, towards the side that the particle comes from
    glm::vec3 velocity{0};  ///< of the surface at the point
};

class Surface {
 public:
    /// Share of a path without contact.
    static constexpr float none = 2;

    virtual ~Surface() = default;

    /// Called once per step, before all paths.
    virtual void begin(const Step&) {}
    /// Writes the share of each path, 0..1, at which it first hits the surface, or `none`.
    virtual void meet(const Ways& ways, float* share) const = 0;
    /// The contact of a path at the share that `meet` returned for it.
    [[nodiscard]] virtual Touch touchAt(const Meeting& meeting) const = 0;
    /// Largest coordinate that enters the test, as a bound on its rounding error.
    [[nodiscard]] virtual float extentMetres() const = 0;
    [[nodiscard]] virtual std::size_t bytes() const { return 0; }
};

/// |x| + |y| + |z|: the contribution of a position to an extent.
[[nodiscard]] inline float sumOfSizes(const glm::vec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

// --- Resolving the contacts of a chunk with all surfaces of a system.

/// Where particles start their path in a step, and its duration.
struct alignas(64) WayBegins {
    WayBegins() {}  // NOLINT: deliberately uninitialised; `take` writes all that is read

    /// `seconds`: one value per particle if `each`, otherwise one for all.
    void take(const Chunk& chunk, const float* seconds, bool each);

    std::array<float, chunkSize> x, y, z, seconds;
};

/// A surface of a system's forces or lives; they are kept in the order of the lists.
struct MetSurface {
    const Surface* surface;
    Contact contact;
};
class MetSurfaces {
 public:
    explicit MetSurfaces(const PartList& parts);
    [[nodiscard]] std::span<const MetSurface> all() const { return {surfaces_.data(), count_}; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    /// For steps in several parts: contacts in all of them together have the friction of one.
    [[nodiscard]] MetSurfaces perPartOf(int parts) const;

 private:
    static constexpr std::size_t maximum = 32;
    std::array<MetSurface, maximum> surfaces_;
    std::size_t count_ = 0;
};

/// Maximum number of contacts of a particle in one step; after the last, the surface carries it.
inline constexpr int maximumContacts = 8;

/// Resolves contacts. On entry, the chunk has the positions that the particles would reach without contacts.
/// `leftSeconds`: from the end of their paths to the end of the step.
void meetSurfaces(Chunk& chunk, const WayBegins& begins, const MetSurfaces& surfaces, float leftSeconds = 0);

}  // namespace dustbench::particles
