// A chunk: the unit of work of the parts, a run of particles small enough to stay in the cache while all parts process
// it.
//
// Units: m, m/s, m/s², s. Frame: world. Owns: nothing. Threads: one chunk, one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

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

}  // namespace dustbench::particles
