// Which cells are solid and how fast they move, on the GPU: what flow::SolidCells knows.
//
// The host keeps what each cell conducts as well, to find closed regions. Units: metres per second. Owns its buffers.
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

    /// Replaces all solids; the cells do not know yet. False where nothing changes: there are none, as before. Throws
    /// InputError as flow::check does.
    [[nodiscard]] bool set(const flow::SolidMask& mask);
    /// Solid cells move as solids and hold nothing.
    void fill(const CellsOnGpu& cells) const;
    /// The outermost cells of solids take the mean of what flows beside them; velocity too where `slip`.
    void extendInto(const CellsOnGpu& cells, bool slip);

    [[nodiscard]] bool any() const { return any_; }
    /// As kinds.glsl has them.
    [[nodiscard]] const gpu::Buffer& kinds() const { return kinds_; }
    [[nodiscard]] std::vector<std::vector<flow::Run>> closedRegions() const;
    [[nodiscard]] std::size_t bytes() const { return kinds_.bytes() + bodies_.bytes() + motions_.bytes(); }

 private:
    struct Motion {
        glm::vec4 velocity, turnPerCell, centreCells;
    };

    flow::CellLayout layout_;
    LedgerVector<std::uint8_t> conductance_;
    gpu::Buffer kinds_, bodies_, motions_;
    Kernel mask_, fill_, extend_;
    bool any_ = false;
};

}  // namespace dustbench::grid_fluid::flow_gl
