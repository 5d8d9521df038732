// Sums on the GPU: inclusive sums of unsigned numbers, compaction (the flagged elements of a buffer, in order), and
// reduction to the sum, minimum or maximum of all elements.
//
// Inclusive sums take three passes: the sum of each tile, the sums of all earlier tiles, the sums within each tile.
//
// Owns: memory for a value of each tile. Threads: the OpenGL thread's. Sums of floats repeat to the bit on one device.
#pragma once

#include <string_view>

#include "methods/kit/gpu/sort/tile_plan.h"

namespace dustbench::gpu {

/// Sums modulo 2³².
class DUSTBENCH_API InclusiveScan {
 public:
    InclusiveScan(Device& device, std::uint32_t capacity);

    /// `sums` may be `elements`.
    void scan(const Buffer& elements, Buffer& sums, const ElementCount& count);

    [[nodiscard]] std::size_t bytes() const { return plan_.bytes() + before_.bytes() + total_.bytes(); }

 private:
    TilePlan plan_;
    Buffer before_, total_;
    Program sumTiles_, sumRow_, scan_;
};

class DUSTBENCH_API Compaction {
 public:
    Compaction(Device& device, std::uint32_t capacity);

    /// Writes the values whose flag is not 0 to the start of `kept`, and their number into the first word of
    /// `keptCount`, where an ElementCount may read it. `kept` must be another buffer than `values`.
    void compact(const Buffer& values, const Buffer& flags, const ElementCount& count, Buffer& kept, Buffer& keptCount);

    [[nodiscard]] std::size_t bytes() const { return plan_.bytes() + before_.bytes(); }

 private:
    TilePlan plan_;
    Buffer before_;
    Program sumTiles_, sumRow_, scan_;
};

enum class Reduce { sum, minimum, maximum };
enum class Number { uint32, float32 };

class DUSTBENCH_API Reduction {
 public:
    Reduction(Device& device, std::uint32_t capacity, Reduce operation, Number number);

    /// Writes the result into the first word of `result`. Without elements it is 0, the maximum of all numbers or their
    /// minimum: infinities of floats.
    void reduce(const Buffer& elements, const ElementCount& count, Buffer& result);

    [[nodiscard]] std::size_t bytes() const { return plan_.bytes() + ofTiles_.bytes(); }

 private:
    TilePlan plan_;
    Buffer ofTiles_;
    Program program_;
};

}  // namespace dustbench::gpu
