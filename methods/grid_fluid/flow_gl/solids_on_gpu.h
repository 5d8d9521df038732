// The solid cells and their motion on the GPU, as in flow::SolidCells.
//
// The host keeps a copy of the conductance of each cell, to find closed regions. Units: metres per second. Owns its
// buffers.
// Threads: the OpenGL thread's.
#pragma once

#include <vector>

#include "methods/grid_fluid/flow/closed_regions.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/solid_mask.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"

namespace dustbench::grid_fluid::flow_gl {

class SolidsOnGpu {
 public:
    SolidsOnGpu(gpu::Device& device, const flow::CellLayout& layout, const flow::Sides& sides, MemoryAccount& account);

    /// Replaces all solids, without updating the state. Returns false if there are none, as before.
    /// Throws InputError as flow::check does.
    [[nodiscard]] bool set(const flow::SolidMask& mask);
    /// Gives the faces of solids their speeds, and empties their cells.
    void fill(const CellsOnGpu& cells) const;
    /// Sets the rim inside the solids to the mean of adjacent moving values; includes the velocity if `slip`.
    void extendInto(const CellsOnGpu& cells, bool slip);

    [[nodiscard]] bool any() const { return any_; }
    /// Kinds of cells as in kinds.glsl.
    [[nodiscard]] const gpu::Buffer& kinds() const { return kinds_; }
    [[nodiscard]] std::vector<std::vector<flow::Run>> closedRegions() const;
    [[nodiscard]] std::size_t bytes() const {
        return kinds_.bytes() + bodies_.bytes() + motions_.bytes() + velocities_.bytes();
    }

 private:
    struct Motion {
        glm::vec4 velocity, turnPerCell, centreCells;
    };

    gpu::Device& device_;
    flow::CellLayout layout_;
    LedgerVector<std::uint8_t> conductance_;
    gpu::Buffer kinds_, bodies_, motions_, velocities_;
    Kernel mask_, fill_, extend_;
    bool any_ = false;
};

}  // namespace dustbench::grid_fluid::flow_gl
