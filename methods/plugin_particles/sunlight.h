// Sunlight on the particles of all systems, if scene::Lights::onDust.
//
// Particles blended by alpha are lit like the shared dust (kit/light/lit_puffs.h). Puffs and sprites also cast shadows:
// on each other, across systems, and on the opaque scene. Points, lines and curves have no size in the world and cast
// none. Additive particles emit their light and stay as they are, and so do meshes, which are
// lit as surfaces.
//
// Units: metres; linear RGB. Owns: copies of the puffs, if several systems cast shadows. Threads: as lit_puffs.h.
#pragma once

#include <optional>
#include <span>

#include "methods/contract/scene.h"
#include "methods/contract/volume.h"
#include "methods/kit/light/lit_puffs.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/kit/particles/render_part.h"

namespace dustbench::plugin_particles {

[[nodiscard]] bool scattersLight(const particles::Look& look);
[[nodiscard]] bool castsShadow(const particles::Look& look);

class Sunlight {
 public:
    /// The scene must outlive it.
    explicit Sunlight(const scene::Scene& scene) : scene_(scene) {}

    /// The puffs of each system that casts shadows, valid until the next call.
    void shine(std::span<const Puffs> casting);
    /// The puffs that cast shadows, of all systems.
    [[nodiscard]] const Puffs& casting() const { return casting_; }
    /// A system's puffs with the colours that they show towards the eye, stored in `colours`.
    [[nodiscard]] Puffs on(const Puffs& puffs, const glm::dvec3& eye, light::LitPuffs& colours) const;

    [[nodiscard]] std::size_t bytes() const { return ledger_.totalBytes(); }

 private:
    const scene::Scene& scene_;
    MemoryLedger ledger_;
    particles::ParticleStore joined_{ledger_};
    Puffs casting_{};
    std::optional<light::SunDepth> depths_;
};

}  // namespace dustbench::plugin_particles
