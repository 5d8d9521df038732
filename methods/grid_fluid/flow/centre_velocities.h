// The velocities at the cells' centres that paths follow, in a ring of slabs. Internal to the advection.
//
// A centre's velocity is the mean of those of two faces: that of the state, uⁿ, or by the last two states half-way
// through the step, u* = uⁿ + ½Δt/Δt₋·(uⁿ − uⁿ⁻¹). For the latter three floats a cell are kept from step to step.
// Units: metres per second. Threads: rows apart. Owns its memory, booked on a ledger.
// Source: Temperton1987. Departs: u* is no faster than the flow, so that it is known how far paths reach.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

/// ½Δt/Δt₋, or 0 if there was no last step. A step that is more than twice as long as the last one is extrapolated as
/// if it were twice as long.
[[nodiscard]] inline float aheadOf(float stepSeconds, float lastStepSeconds) {
    return lastStepSeconds > 0 ? std::min(0.5f * stepSeconds / lastStepSeconds, 1.0f) : 0.0f;
}

/// From the last two states to the middle of the step.
struct Extrapolation {
    float ahead = 0;             ///< aheadOf
    glm::vec3 maximumSpeeds{0};  ///< of the flow along each axis
};

class CentreVelocities {
 public:
    CentreVelocities(const CellLayout& layout, MemoryAccount& memory) : layout_(layout), ring_(memory), last_(memory) {}

    /// Holds so many slabs from now on.
    void hold(std::size_t slabs);
    /// From now on there is memory for what is kept from step to step, as an extrapolation requires.
    void keepLast();
    /// Finds those of row (j, k), once a step; beyond the box they are those of the outermost cells. Of the state, if
    /// there is no extrapolation.
    void findRow(const CellField& cells, const Extrapolation* extrapolation, int j, int k);
    /// Moves what is kept from step to step by whole cells; new cells had the wind.
    void scroll(glm::ivec3 by, glm::vec3 wind);

    /// Four floats a cell, the fourth without meaning: of slab k, −1 to nz, from its first ghost on.
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
