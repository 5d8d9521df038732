// Which cells are solid and how fast they move, on the GPU: what fluid::SolidCells knows.
//
// The host keeps what each cell conducts as well, to find closed regions. Units: metres per second. Owns its buffers.
// Threads: the OpenGL thread's.
#pragma once

#include <vector>

#include "methods/shared/fluid/closed_regions.h"
#include "methods/shared/fluid/fluid_box.h"
#include "methods/shared/fluid/solid_mask.h"
#include "methods/shared/fluid_gl/cells_on_gpu.h"
#include "methods/shared/fluid_gl/kernel.h"

namespace dustbench::fluid_gl {

class SolidsOnGpu {
 public:
    SolidsOnGpu(gpu::Device& device, const fluid::CellLayout& layout, const fluid::Sides& sides,
                MemoryAccount& account);

    /// Replaces all solids; the cells do not know yet. False where nothing changes: there are none, as before. Throws
    /// InputError as fluid::check does.
    [[nodiscard]] bool set(const fluid::SolidMask& mask);
    /// Solid cells move as solids and hold nothing.
    void fill(const CellsOnGpu& cells) const;
    /// The outermost cells of solids take the mean of what flows beside them; velocity too where `slip`.
    void extendInto(const CellsOnGpu& cells, bool slip);

    [[nodiscard]] bool any() const { return any_; }
    /// As kinds.glsl has them.
    [[nodiscard]] const gpu::Buffer& kinds() const { return kinds_; }
    [[nodiscard]] std::vector<std::vector<fluid::Run>> closedRegions() const;
    [[nodiscard]] std::size_t bytes() const { return kinds_.bytes() + bodies_.bytes() + motions_.bytes(); }

 private:
    struct Motion {
        glm::vec4 velocity, turnPerCell, centreCells;
    };

    fluid::CellLayout layout_;
    LedgerVector<std::uint8_t> conductance_;
    gpu::Buffer kinds_, bodies_, motions_;
    Kernel mask_, fill_, extend_;
    bool any_ = false;
};

}  // namespace dustbench::fluid_gl
