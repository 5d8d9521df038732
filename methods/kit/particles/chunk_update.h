// Updates one chunk by a step in the thesis's order: all parts in sequence, while the chunk stays in the cache.
//
// Threads: pure except for the chunk passed in. Source: Thesis, 3.3.2 (order of the update) and 5.1 (semi-implicit
// Euler).
#pragma once

#include <array>

#include "methods/kit/particles/contacts.h"
#include "methods/kit/particles/newborns.h"
#include "methods/kit/particles/part_list.h"

namespace dustbench::particles {

/// Storage for temporary values of an update, on the stack of the updating thread.
struct alignas(64) ChunkScratch {
    ChunkScratch() {}  // NOLINT: deliberately uninitialised; each step writes before it reads

    std::array<std::array<float, chunkSize>, 10> values;
    std::array<std::uint8_t, chunkSize> dead;

    /// Points the chunk's scratch pointers at this storage.
    void lend(Chunk& chunk, bool shaded);
};

/// Clears the acceleration, then applies age, life, colour, shading, size, forces, integration. Sets `chunk.dead`.
/// `surfaces`: the surfaces of `parts`.
void updateChunk(Chunk& chunk, const PartList& parts, const MetSurfaces& surfaces, const Step& step);

/// The same without surfaces, and without `touch`, for systems in which a force then settles particles.
void advanceChunk(Chunk& chunk, const PartList& parts, const Step& step);

/// Sets position, velocity, lifetime, colour and size of newborns whose serial, age and moment are set.
void initialiseNewborns(Newborns& newborns, const PartList& parts, const MetSurfaces& surfaces, const Step& step);

}  // namespace dustbench::particles
