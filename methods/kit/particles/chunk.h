// A chunk: the unit of work of the parts, a run of particles small enough to stay in the cache while all parts process
// it; and newborns, a chunk of particles that are not yet in the store.
//
// Units: m, m/s, m/s², s. Frame: world. Owns: nothing. Threads: one chunk or set of newborns, one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "methods/kit/particles/step.h"

namespace dustbench::particles {

struct Hit;

/// Particles per chunk: twelve columns and the scratch of an update are 46 KiB, which fits the second-level cache.
inline constexpr std::size_t chunkSize = 512;

/// Pointers to `count` particles. The arrays never overlap, so that kernels may declare them `__restrict`.
struct Chunk {
    std::size_t first = 0;  ///< index in the store; 0 for newborns
    std::size_t count = 0;
    const std::uint64_t* serial = nullptr;
    float *x = nullptr, *y = nullptr, *z = nullptr;
    float *velocityX = nullptr, *velocityY = nullptr, *velocityZ = nullptr;
    float *age = nullptr, *lifetime = nullptr;
    float* radius = nullptr;
    float* opacity = nullptr;
    float *red = nullptr, *green = nullptr, *blue = nullptr;  ///< null if one colour applies to all

    // Valid only during this update:
    float* share = nullptr;  ///< age / lifetime, 0..1
    float *accelerationX = nullptr, *accelerationY = nullptr, *accelerationZ = nullptr;
    float *airX = nullptr, *airY = nullptr, *airZ = nullptr;  ///< the air's velocity at the particle
    float *luminosityRed = nullptr, *luminosityGreen = nullptr, *luminosityBlue = nullptr;  ///< null without shading
    std::uint8_t* dead = nullptr;      ///< 1: dies in this update; 0: lives
    std::vector<Hit>* hits = nullptr;  ///< receives contacts with surfaces; null: nobody watches them

    [[nodiscard]] bool hasColours() const { return red != nullptr; }
};

/// Particles born in this step, before they are added to the store.
/// `chunk.age` is the time between birth and the end of the step; `moment` is 0 at the step's start and 1 at its end.
struct Newborns {
    Chunk chunk;
    const float* moment;
    const Emitter* const*
        emitter;  ///< of each newborn: emitters alternate, so that each gets an equal share, evenly spaced

    /// Position of newborn `i`'s emitter at its birth, on its straight path during the step: the centre of the source.
    [[nodiscard]] glm::vec3 centre(std::size_t i) const {
        return glm::mix(emitter[i]->from, emitter[i]->to, moment[i]);
    }
    void setPosition(std::size_t i, const glm::vec3& position) const {
        chunk.x[i] = position.x;
        chunk.y[i] = position.y;
        chunk.z[i] = position.z;
    }
    void setVelocity(std::size_t i, const glm::vec3& velocity) const {
        chunk.velocityX[i] = velocity.x;
        chunk.velocityY[i] = velocity.y;
        chunk.velocityZ[i] = velocity.z;
    }
};

}  // namespace dustbench::particles
