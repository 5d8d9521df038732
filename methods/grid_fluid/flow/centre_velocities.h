// The velocities at the cells' centres that paths follow, in a ring of slabs. Internal to the advection.
//
// A centre's velocity is the mean of those of two faces: that of the state, uⁿ, or extrapolated from the last two
// states to the middle of the step, u* = uⁿ + ½Δt/Δt₋·(uⁿ − uⁿ⁻¹). The latter keeps three floats per cell between
// steps. Units: metres per second. Threads: rows are independent. Owns its memory, booked on a ledger.
// Source: Temperton1987. Departs: u* is limited to the speed of the flow, which bounds the reach of paths.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

/// ½Δt/Δt₋, or 0 if there was no last step. The ratio Δt/Δt₋ is limited to 2.
[[nodiscard]] inline float aheadOf(float stepSeconds, float lastStepSeconds) {
    return lastStepSeconds > 0 ? std::min(0.5f * stepSeconds / lastStepSeconds, 1.0f) : 0.0f;
}

/// Extrapolation from the last two states to the middle of the step.
struct Extrapolation {
    float ahead = 0;             ///< aheadOf
    glm::vec3 maximumSpeeds{0};  ///< of the flow along each axis
};

class CentreVelocities {
 public:
    CentreVelocities(const CellLayout& layout, MemoryAccount& memory) : layout_(layout), ring_(memory), last_(memory) {}

    /// Stores `slabs` slabs from now on.
    void hold(std::size_t slabs);
    /// Allocates the memory that extrapolation keeps between steps.
    void keepLast();
    /// Computes those of row (j, k), once per step; beyond the box they equal those of the outermost cells. Without
    /// extrapolation they are those of the state.
    void findRow(const CellField& cells, const Extrapolation* extrapolation, int j, int k);
    /// Moves the data kept between steps by whole cells; new cells get the wind's velocity.
    void scroll(glm::ivec3 by, glm::vec3 wind);

    /// Four floats per cell, the fourth unused, of slab k (−1 to nz), from its first ghost on.
    [[nodiscard]] float* slab(int k) {
        return ring_.data() + static_cast<std::size_t>(k + 1) % slabs_ * layout_.slab * 4;
    }
    /// The whole ring; slab k has index (k + 1) mod `slabs()`.
    [[nodiscard]] const float* data() const { return ring_.data(); }
    [[nodiscard]] std::size_t slabs() const { return slabs_; }

 private:
    template <typename StoreAt>
    void findCells(const CellField& cells, int j, int k, const StoreAt& storeAt);
    [[nodiscard]] float* row(int j, int k) { return slab(k) + layout_.at(-1, j, -1) * 4; }
    [[nodiscard]] std::size_t lastFloatsOfRow() const;
    [[nodiscard]] float* lastOfRow(int j, int k);

    CellLayout layout_;
    LedgerVector<float> ring_;
    LedgerVector<float> last_;  ///< uⁿ⁻¹ of all cells, three floats each, if kept
    std::size_t slabs_ = 1;
};

}  // namespace dustbench::grid_fluid::flow
