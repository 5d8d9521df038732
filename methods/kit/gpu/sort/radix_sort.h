// Stable radix sort of pairs of a 32-bit key and a 32-bit index on the GPU, by ascending key, and keys by which it
// orders depths.
//
// Four passes over digits of 8 bits, the least significant first; two for keys of 16 bits. Each pass counts the values
// of its digit and moves every pair to its place. A place depends on the counts of all earlier tiles of pairs, which
// are found in one of two ways, both with the same result.
//
// Owns: memory for a second copy of the pairs, and for counts. Threads: the OpenGL thread's.
// Source: AdinetsMerrill2022; MerrillGarland2016.
#pragma once

#include <bit>
#include <cstdint>

#include "methods/contract/choices.h"
#include "methods/kit/gpu/sort/tile_plan.h"

namespace dustbench::gpu {

/// Orders like the floats, except NaN; both zeros have one key. Equals the function of sortable.glsl.
[[nodiscard]] constexpr std::uint32_t sortableKey(float value) {
    constexpr std::uint32_t sign = 0x80000000;
    const auto bits = std::bit_cast<std::uint32_t>(value == 0 ? 0.0f : value);
    return (bits & sign) != 0 ? ~bits : bits | sign;
}

enum class DepthOrder { frontToBack, backToFront };

/// Keys of depths, front to back or back to front. Equal depths keep the order of their indices in both directions.
class DUSTBENCH_API DepthKeys {
 public:
    DepthKeys(Device& device, std::uint32_t capacity);

    /// Writes a key for each depth, and the indices 0, 1, 2 …
    void write(const Buffer& depths, const ElementCount& count, DepthOrder order, Buffer& keys, Buffer& indices);

 private:
    TilePlan plan_;
    Program program_;
};

/// How a tile learns the counts of the tiles before it.
enum class EarlierTiles {
    automatic,  ///< lookBack on NVIDIA's GPUs, else scan
    lookBack,   ///< from what earlier tiles publish in the same pass; reads the keys once less in each pass
    scan,       ///< by counting all tiles first; needs no progress of groups that wait for each other
};
inline constexpr Choices<EarlierTiles> earlierTilesChoices{
    {"auto", EarlierTiles::automatic}, {"look_back", EarlierTiles::lookBack}, {"scan", EarlierTiles::scan}};

/// How the threads of a warp rank their keys.
enum class WarpRanks {
    automatic,  ///< subgroups where the device has subgroups of 32 threads
    subgroups,  ///< by ballots
    shared,     ///< by masks in shared memory
};
inline constexpr Choices<WarpRanks> warpRanksChoices{
    {"auto", WarpRanks::automatic}, {"subgroups", WarpRanks::subgroups}, {"shared", WarpRanks::shared}};

struct RadixSortSettings {
    EarlierTiles earlierTiles = EarlierTiles::automatic;
    WarpRanks warpRanks = WarpRanks::automatic;
    std::uint32_t keysPerThread = 16;  ///< 1 to 24; a tile has 256 threads
};

class DUSTBENCH_API RadixSort {
 public:
    /// `automatic` settings become those of the device. Throws InputError for lookBack if the device cannot.
    RadixSort(Device& device, std::uint32_t capacity, RadixSortSettings settings = {});

    /// Whether a group may wait for another. llvmpipe ends every loop after 65,535 iterations, even one that waits, and
    /// sorts wrongly then. With one thread (LP_NUM_THREADS=1) its groups run one after the other and never wait.
    [[nodiscard]] static bool canLookBack(const Device& device);

    /// Sorts the first `count` pairs in place. Both buffers have room for `capacity` elements. `keyBits`: 16 or 32;
    /// with 16, keys must be below 2¹⁶, and two passes suffice.
    void sort(Buffer& keys, Buffer& indices, const ElementCount& count, int keyBits = 32);

    [[nodiscard]] const RadixSortSettings& settings() const { return settings_; }
    [[nodiscard]] std::size_t bytes() const;

 private:
    void countAllDigits(const Buffer& keys, int passes);
    void countTiles(int place, const Buffer& keys);

    RadixSortSettings settings_;
    TilePlan plan_;
    Buffer spareKeys_, spareIndices_;
    Buffer totals_;  ///< of each digit's values; then a ticket for each pass
    Buffer states_;  ///< counts of tiles by value
    Program count_;
    Program sumRows_;  ///< unused with look-back
    Program scatter_;
};

}  // namespace dustbench::gpu
