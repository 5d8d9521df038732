// Moves particles that hit surfaces in a step: each continues from the first contact with its new velocity for the rest
// of the step, until there is no further contact.
//
// Threads: pure except for the chunk passed in. Source: Thesis, 5.3.2 and 6.1.1. Departs: the particle bounces at the
// point of contact; in the thesis it restarts from its previous position.
#pragma once

#include <array>
#include <span>

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/part_list.h"

namespace dustbench::particles {

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
