// The particles of a shape as a structure of arrays: ParticleStore plus the columns that voxels need.
//
// Memory: 76 bytes per particle, 88 with places of birth. Units: m, m/s, s; `radius` is that of a puff. Frame: world.
// Colours: linear RGB, as displayed. Owns: its columns, on a ledger. Threads: any thread may read; writers need
// disjoint ranges.
#pragma once

#include <glm/glm.hpp>

#include "methods/kit/particles/particle_store.h"

namespace dustbench::voxel_shape {

struct ShapeParticles {
    /// Flag in `place`: the particle is not in an active voxel, or waits at a full one. The other bits then identify
    /// the last voxel that it was in or met.
    static constexpr std::uint32_t outside = 0x80000000u;

    explicit ShapeParticles(MemoryLedger& ledger);

    [[nodiscard]] std::size_t size() const { return store.size(); }
    void resize(std::size_t count);
    void move(std::size_t from, std::size_t to);
    [[nodiscard]] std::uint64_t hash() const;
    /// Call before any particle is born.
    void keepBirthplaces() { keepsBirthplaces_ = true; }
    [[nodiscard]] bool keepsBirthplaces() const { return keepsBirthplaces_; }

    particles::ParticleStore store;       ///< `age` is 0 inside the shape and counts from leaving it
    LedgerVector<std::uint32_t> place;    ///< index of its voxel
    LedgerVector<float> settlingSeconds;  ///< time left until it has its voxel's look
    LedgerVector<float> picture;          ///< of an animated texture: pictures shown so far
    LedgerVector<float> pictureSpeed;     ///< pictures per second
    LedgerVector<glm::vec3> birthplace;   ///< in the shape's own frame; empty unless kept

 private:
    bool keepsBirthplaces_ = false;
};

}  // namespace dustbench::voxel_shape
