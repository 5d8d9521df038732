// Updates one chunk by a step in the thesis's order: all parts in sequence, while the chunk stays in the cache.
//
// Units: m, s. Threads: pure except for the chunk or the block passed in, which belong to one thread.
// Source: Thesis, 3.3.2 (order of the update) and 5.1 (semi-implicit Euler).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/contacts.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_list.h"

namespace dustbench::particles {

/// Columns for a few newborns, on the stack of the initialising thread.
class NewbornBlock {
 public:
    static constexpr std::size_t size = 128;

    NewbornBlock() {}  // NOLINT: deliberately uninitialised; the parts write every column

    /// Births `first`..`first + count` of a step, numbered from `serial` on, with moment and age set.
    [[nodiscard]] Newborns newborns(std::size_t first, std::size_t count, std::uint64_t serial, const Births& births,
                                    std::span<const Emitter> emitters, double stepSeconds);

 private:
    std::array<std::uint64_t, size> serial_;
    std::array<float, size> moment_;
    std::array<const Emitter*, size> emitter_;
    alignas(64) std::array<std::array<float, size>, 13> columns_;
};

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
