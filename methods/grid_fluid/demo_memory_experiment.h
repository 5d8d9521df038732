// Counts the bytes that the published demo takes (claim R26), by the ledger of the GPU, with its fields allocated.
//
// Threads: the OpenGL thread's. Source: Senger2009, table 1 and 5.2; Crane2007, 30.3.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/experiment.h"

namespace dustbench::grid_fluid::demo_memory {

/// Of the flow and its solids on a grid, of either scheme, and of what a ray caster draws into at a size of picture:
/// a layer of four floats a pixel and the scene's depth.
struct DemoMemory {
    std::size_t fields = 0, picture = 0;
    [[nodiscard]] double total() const { return static_cast<double>(fields + picture); }
};
[[nodiscard]] DemoMemory measureMemory(gpu::Device& device, const glm::ivec3& cells, const glm::ivec2& pixels,
                                       bool asPublished);

/// The experiment `demo_memory`, for 1920x1080 pixels unless said otherwise:
///     bytes_128x64x64, megabytes_256x128x128  of the demo; a megabyte is 10^6 bytes
///     bytes_128x64x64_floats                  of our own scheme, in floats
///     megabytes_256x128x128_1088              with eight lines of pixels more
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::demo_memory
