// The particles of a shape as a structure of arrays: those of particles/ParticleStore, and what voxels ask for besides.
//
// Memory: 76 bytes a particle, 88 with places of birth. Units: m, m/s, s; `radius` is a puff's. Frame: world. Colours:
// linear RGB, as seen. Owns: its columns, on a ledger. Threads: const access from any; writers on disjoint ranges.
#pragma once

#include <glm/glm.hpp>

#include "methods/kit/particles/particle_store.h"

namespace dustbench::voxel_shape {

struct ShapeParticles {
    /// Set in `place` while a particle is in no active voxel, or in one that was full when it came; the rest is then
    /// the last one that it was in or met.
    static constexpr std::uint32_t outside = 0x80000000u;

    explicit ShapeParticles(MemoryLedger& ledger);

    [[nodiscard]] std::size_t size() const { return store.size(); }
    void resize(std::size_t count);
    void move(std::size_t from, std::size_t to);
    [[nodiscard]] std::uint64_t hash() const;
    /// Before any particle is born.
    void keepBirthplaces() { keepsBirthplaces_ = true; }
    [[nodiscard]] bool keepsBirthplaces() const { return keepsBirthplaces_; }

    particles::ParticleStore store;       ///< `age` counts from when a particle left the shape, and is 0 in it
    LedgerVector<std::uint32_t> place;    ///< index of its voxel
    LedgerVector<float> settlingSeconds;  ///< left until it looks as its voxel says
    LedgerVector<float> picture;          ///< of an animated texture, as many as have been shown
    LedgerVector<float> pictureSpeed;     ///< pictures a second
    LedgerVector<glm::vec3> birthplace;   ///< in the shape's own frame; empty unless kept

 private:
    bool keepsBirthplaces_ = false;
};

}  // namespace dustbench::voxel_shape
