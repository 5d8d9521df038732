// The state of a fluid on the GPU: the contents of flow::CellField, in two buffers of the same order.
//
// Units: metres per second, kelvin above the air. Owns the buffers. Threads: the OpenGL thread's.
#pragma once

#include <utility>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/kit/gpu/buffer.h"

namespace dustbench::grid_fluid::flow_gl {

struct CellsOnGpu {
    CellsOnGpu(gpu::Device& device, std::string_view label, const flow::CellLayout& layout)
        : moving(device, label, layout.padded() * bytesMoving), carried(device, label, layout.padded() * bytesCarried) {
        moving.clear();
        carried.clear();
    }

    /// Binds both buffers to consecutive binding points.
    void bind(std::uint32_t first) const {
        moving.bindStorage(first);
        carried.bindStorage(first + 1);
    }
    [[nodiscard]] std::size_t bytes() const { return moving.bytes() + carried.bytes(); }

    static constexpr std::size_t bytesMoving = 4 * sizeof(float), bytesCarried = 2 * sizeof(float);
    gpu::Buffer moving;   ///< velocity and density
    gpu::Buffer carried;  ///< temperature and reaction
};

}  // namespace dustbench::grid_fluid::flow_gl
