// Records the particles affected by an event in a step, such as death: noted per chunk on any thread, then collected in
// storage order.
//
// Owns: its lists, booked on a ledger: two bytes per particle, and four per recorded one.
// Threads: `note` from any thread, one chunk each.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/particles/chunk.h"

namespace dustbench::particles {

/// Calls `visit(i)` for each of `count` flags that is 1, in ascending order, testing eight at a time; all flags must
/// be 0 or 1.
template <typename Visit>
void forEachFlagged(const std::uint8_t* flags, std::size_t count, const Visit& visit) {
    static_assert(std::endian::native == std::endian::little, "the lowest byte of a word is the first flag");
    std::size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, flags + i, sizeof eight);
        for (; eight != 0; eight &= eight - 1) visit(i + static_cast<std::size_t>(std::countr_zero(eight)) / 8);
    }
    for (; i < count; ++i)
        if (flags[i]) visit(i);
}

class DUSTBENCH_API NotedParticles {
 public:
    explicit NotedParticles(MemoryLedger& ledger, const char* account = "particle deaths");

    /// Reserves capacity for this many particles.
    void prepare(std::size_t particles);
    /// Notes those of the chunk's `count` particles whose flag is 1 (the others are 0).
    void note(std::size_t chunk, const std::uint8_t* flags, std::size_t count);
    /// Returns the storage indices of all noted particles, ascending, for any number of threads.
    [[nodiscard]] std::span<const std::uint32_t> collect();

 private:
    LedgerVector<std::uint16_t> within_;  ///< for chunk c: positions within it, from c·chunkSize on
    LedgerVector<std::uint32_t> counts_;  ///< for chunk c: number of noted particles
    LedgerVector<std::uint32_t> indices_;
};

}  // namespace dustbench::particles
