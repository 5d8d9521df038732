// The particles that a view needs: without those out of sight, and with far ones thinned out.
//
// Culling leaves out particles that certainly cover no pixel: those whose bounding sphere is outside the view's four
// sides or behind the eye. The picture stays the same, bit by bit, since the others keep their order.
//
// Detail thins out particles whose radius covers p < P pixels, and enlarges the others to P pixels. With f = (p/P)², a
// number u in [0, 1) for each particle, and a band b = (1 − f)/4 in which particles fade:
//
//     F = f/(1 − b/2),   w = clamp((F − u)/(F·b), 0, 1),   r' = r/√f,   τ' = w·τ (additive light: α' = w·α)
//
// The mean of w is f, so the mean mass w·τ·r'² is that of all particles, and no particle appears or vanishes at once.
// u is the fraction of serial · golden ratio: particles born one after the other, which are close to each other, are
// thinned out evenly.
//
// Source: Cook2007 (thinning, enlargement and fading); departs: by distance of each particle.
// Units: metres, pixels. Owns: copies of the particles in sight, and a ledger. Threads: one at a time; uses the current
// oneTBB arena, bit-identical at any number of threads.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "methods/contract/view.h"
#include "methods/contract/volume.h"
#include "methods/kit/particles/noted_particles.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/kit/particles/render_part.h"

namespace dustbench::plugin_particles {

struct Sight {
    bool culls = false;
    float detailPixels = 0;  ///< P; 0: all particles
};

/// How a particle is drawn: a weight of 0 if it is left out.
struct Thinned {
    float weight = 1;
    float growth = 1;  ///< r'/r
};
[[nodiscard]] Thinned thinned(std::uint64_t serial, float radiusPixels, float detailPixels);

/// Whether the particles drawn with this look differ between views.
[[nodiscard]] bool dependsOnView(const particles::Look& look, const Sight& sight);

class SeenParticles {
 public:
    /// The particles to draw, in the same order: these ones, or copies that are valid until the next call. Curves and
    /// surfaces get all particles, because they connect them; only particles that have a size are thinned out.
    [[nodiscard]] Puffs of(const Puffs& all, const scene::View& view, const particles::Look& look, float stepSeconds,
                           const Sight& sight);

    [[nodiscard]] std::size_t bytes() const { return ledger_.totalBytes(); }

 private:
    MemoryLedger ledger_;
    particles::NotedParticles seen_{ledger_, "particles in sight"};
    particles::ParticleStore copies_{ledger_};
};

}  // namespace dustbench::plugin_particles
