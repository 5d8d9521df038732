// Connects a fluid's box that follows the vehicle with the trail of dust that it leaves behind, and tracks the mass of
// both.
//
// Dust that leaves the box, because the box moves or by the flow through its sides, enters the trail at that place;
// dust that the box reaches enters the box. Units: m³ (density times volume). Frame: world. Threads: one at a time.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/grid_fluid/flow/solver.h"
#include "methods/grid_fluid/trail/dust_trail.h"

namespace dustbench::grid_fluid {

class FluidTrail {
 public:
    FluidTrail(const flow::FluidSettings& settings, double extinctionPerMetre, MemoryLedger& ledger);

    /// Call this before the box moves by `by` cells: takes the dust that leaves it. `density`: that of its cells, x
    /// fastest.
    void leave(const flow::FluidBox& box, const glm::ivec3& by, std::span<const float> density);
    /// Call this after the box or the wind has moved: gives it the dust that enters. The solver's solids must be set
    /// again.
    void enter(flow::Solver& solver);
    /// Call this after each step.
    void pass(const flow::Solver& solver, float seconds, std::span<const flow::FluidSource> sources);

    [[nodiscard]] const DustTrail& dust() const { return dust_; }
    /// Mass raised by all sources, minus the share that has died of age: equals the mass of box and trail if nothing is
    /// lost. Excludes sources that are given by density only. Empty while there is hardly any dust.
    [[nodiscard]] std::optional<double> dueM3() const;

 private:
    flow::FluidSettings settings_;
    DustTrail dust_;
    double unseenDensity_;
    double dueM3_ = 0, maximumDueM3_ = 0;
    std::vector<flow::AddedDensity> added_;
};

}  // namespace dustbench::grid_fluid
