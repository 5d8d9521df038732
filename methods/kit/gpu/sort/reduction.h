// Sum, minimum or maximum of a buffer's elements on the GPU.
//
// Owns: memory for a value of each tile. Threads: the OpenGL thread's. Sums of floats repeat to the bit on one device.
#pragma once

#include <string_view>

#include "methods/kit/gpu/sort/tile_plan.h"

namespace dustbench::gpu {

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
