// Joins a fluid's box that follows the vehicle to the trail of dust that it leaves behind, and keeps the account of
// both.
//
// What leaves the box, by its moves and by the flow through its sides, enters the trail at that place; dust that the
// box comes upon enters the box. Units: m³ (density times volume). Frame: world. Threads: one at a time.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "methods/grid_fluid/flow/fluid_settings.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/grid_fluid/flow/solver.h"
#include "methods/grid_fluid/trail/dust_trail.h"

namespace dustbench::grid_fluid {

class FluidTrail {
 public:
    FluidTrail(const flow::FluidSettings& settings, double extinctionPerMetre, MemoryLedger& ledger);

    /// Before the box moves by so many cells: what falls out of it. `density`: of its cells, x fastest.
    void leave(const flow::FluidBox& box, const glm::ivec3& by, std::span<const float> density);
    /// After it has moved, or the wind has: what comes to lie in it. The solver's solids must be set again.
    void enter(flow::Solver& solver);
    /// After each step.
    void pass(const flow::Solver& solver, float seconds, std::span<const flow::FluidSource> sources);

    [[nodiscard]] const DustTrail& dust() const { return dust_; }
    /// What all sources raised, less what has died of age: the mass of box and trail if nothing is lost. What sources
    /// give by their density alone is not counted. Empty while there is next to nothing.
    [[nodiscard]] std::optional<double> dueM3() const;

 private:
    flow::FluidSettings settings_;
    DustTrail dust_;
    double unseenDensity_;
    double dueM3_ = 0, maximumDueM3_ = 0;
    std::vector<flow::AddedDensity> added_;
};

}  // namespace dustbench::grid_fluid
