// The boundaries of the flow on the GPU: the ghosts beyond the sides of the box, as flow::fillGhosts fills them, and
// the solid cells with their motion, as in flow::SolidCells.
//
// The host keeps a copy of the conductance of each cell, to find closed regions. Units: metres per second. Owns its
// buffers. Threads: the OpenGL thread's.
#pragma once

#include <vector>

#include "methods/grid_fluid/flow/box_ghosts.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/pressure_solver.h"
#include "methods/grid_fluid/flow/solid_cells.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"

namespace dustbench::grid_fluid::flow_gl {

class GhostsOnGpu {
 public:
    GhostsOnGpu(gpu::Device& device, const glm::ivec3& cells, const flow::GhostRule& rule);
    /// As flow::fillGhosts and flow::setSideFaces.
    void fill(const CellsOnGpu& state);
    void setSideFaces(const CellsOnGpu& state);

 private:
    glm::ivec3 cells_;
    Kernel ghosts_, sideFaces_;
};

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
