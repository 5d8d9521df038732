// What happens to one chunk in a step, in the thesis's order: all parts, one after another, while it stays in the
// cache.
//
// Threads: pure but for the chunk it is given. Source: Thesis, 3.3.2 (order of the update) and 5.1 (semi-implicit
// Euler).
#pragma once

#include <array>

#include "methods/kit/particles/newborns.h"
#include "methods/kit/particles/part_list.h"

namespace dustbench::particles {

/// Room for what lives during an update alone; it belongs on the stack of the thread that updates.
struct alignas(64) ChunkScratch {
    ChunkScratch() {}  // NOLINT: left as it is on purpose, each step writes what it reads

    std::array<std::array<float, chunkSize>, 10> values;
    std::array<std::uint8_t, chunkSize> dead;

    /// Points the chunk's pointers here.
    void lend(Chunk& chunk, bool shaded);
};

/// Zero acceleration, age, life, colour, shading, size, forces, integration. `chunk.dead` tells who must go.
void updateChunk(Chunk& chunk, const PartList& parts, const Step& step);

/// Position, velocity, lifetime, colour, size of newborns whose serial, age and moment are known.
void initialiseNewborns(Newborns& newborns, const PartList& parts, const Step& step);

}  // namespace dustbench::particles
