// The fluid of the published demo on the CPU, as a plain implementation: all quantities at the centres of cells, stored
// as halves.
//
// A step advects by MacCormack, forward and clamped to the eight nodes, adds sources and forces, and sweeps the
// pressure six times, so the stored flow is not divergence-free. Units: SI. Frame: world. Owns all fields. Threads:
// slabs in parallel. Source: Crane2007, 30.2; Senger2009, 4.1.
#pragma once

#include "methods/grid_fluid/demo/demo_grid.h"
#include "methods/grid_fluid/demo/demo_rule.h"
#include "methods/grid_fluid/flow/solver.h"

namespace dustbench::grid_fluid::demo {

class DemoSolver final : public flow::Solver {
 public:
    DemoSolver(const DemoSettings& settings, MemoryLedger& ledger);

    void setSolids(const flow::SolidMask& mask) override;
    flow::StepReport step(double stepSeconds, std::span<const flow::FluidSource> sources,
                          const StageClock& clock = StageClock()) override;
    /// Always throws: the demo's box cannot move.
    void scroll(glm::ivec3 cells) override;
    [[nodiscard]] const flow::FluidBox& box() const override { return settings_.box; }
    [[nodiscard]] std::int64_t steps() const override { return steps_; }
    [[nodiscard]] std::uint64_t stateHash() const override;
    void gather(flow::Lane lane, std::span<float> to) const override;
    void gatherStored(flow::Lane lane, std::span<float> to) const override { gather(lane, to); }
    [[nodiscard]] std::vector<float> pressuresM2PerS2() const override;
    [[nodiscard]] float divergencePerStep() const override;
    [[nodiscard]] bool onGpu() const override { return false; }
    void gather(flow::Lane lane, const gpu::Texture& to) const override;
    void addDensity(std::span<const flow::AddedDensity> added) override;
    [[nodiscard]] MemoryReport gpuMemory() const override { return {}; }

 private:
    using Scalars = DemoGrid<float>;
    using Vectors = DemoGrid<glm::vec4>;
    [[nodiscard]] bool isInside(const glm::ivec3& c) const {
        return glm::all(glm::greaterThanEqual(c, glm::ivec3(0))) && glm::all(glm::lessThan(c, settings_.box.cells));
    }
    [[nodiscard]] bool isSolid(const glm::ivec3& c) const { return solid_.at(c).w > 0; }
    [[nodiscard]] glm::vec3 neighbourVelocity(const Vectors& velocity, const glm::ivec3& c, int axis, int side) const;
    [[nodiscard]] float neighbourPressure(const Scalars& pressure, const glm::ivec3& c, int axis, int side) const;
    [[nodiscard]] float divergenceAt(const glm::ivec3& c) const;
    template <typename Cell>
    void forCells(const Cell& cell) const;
    template <typename Value>
    void advect(const DemoGrid<Value>& field, DemoGrid<Value>& guess, DemoGrid<Value>& result, float cellsPerSpeed,
                float kept);
    void addSource(const flow::FluidSource& source, float seconds);
    void applyForces(float seconds);
    void project();
    void requireNumbers() const;

    DemoSettings settings_;
    Vectors velocity_, otherVelocity_, vector_;  ///< `w` of a velocity: the reaction
    Scalars density_, temperature_, pressure_, scalar_;
    Vectors solid_;  ///< velocity of a solid; w: whether the cell is solid
    std::int64_t steps_ = 0;
    double lastStepSeconds_ = 0;
};

}  // namespace dustbench::grid_fluid::demo
