// Inclusive sums of unsigned numbers on the GPU, and compaction: the flagged elements of a buffer, in order.
//
// Three passes: the sum of each tile, the sums of all earlier tiles, the sums within each tile.
//
// Owns: memory for a sum of each tile. Threads: the OpenGL thread's.
#pragma once

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

}  // namespace dustbench::gpu
