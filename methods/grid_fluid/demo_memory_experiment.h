// Measures the GPU memory of the published demo (claim R26) with the device's ledger, with all fields allocated.
//
// Threads: the OpenGL thread's. Source: Senger2009, table 1 and 5.2; Crane2007, 30.3.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/experiment.h"

namespace dustbench::grid_fluid::demo_memory {

/// Bytes of the flow and its solids on a grid, for either scheme, and of the ray caster's targets at a picture size: a
/// layer of four floats per pixel and the scene's depth.
struct DemoMemory {
    std::size_t fields = 0, picture = 0;
    [[nodiscard]] double total() const { return static_cast<double>(fields + picture); }
};
[[nodiscard]] DemoMemory measureMemory(gpu::Device& device, const glm::ivec3& cells, const glm::ivec2& pixels,
                                       bool asPublished);

/// The experiment `demo_memory`, for 1920x1080 pixels unless stated otherwise:
///     bytes_128x64x64, megabytes_256x128x128  of the demo; a megabyte is 10^6 bytes
///     bytes_128x64x64_floats                  of our own scheme, in floats
///     megabytes_256x128x128_1088              with eight more rows of pixels
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::demo_memory
