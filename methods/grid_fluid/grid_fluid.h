// Smoke, fire and dust that flow: an Eulerian solver in a box, whose density is ray cast into the scene.
//
// The box may follow the vehicle; solids, the vehicle and the ground are voxelised each step. Its wheels raise as much
// dust as the shared cloud has (dust_mass.h).
//
// Source: Senger2009, 4 (after Crane2007). Departs: reports/decisions/0006-fluid-grid.md.
#pragma once

#include <memory>
#include <optional>

#include "methods/grid_fluid/emitters.h"
#include "methods/grid_fluid/flow_solver.h"
#include "methods/grid_fluid/fluid_setup.h"
#include "methods/grid_fluid/fluid_solids.h"
#include "methods/shared/method.h"
#include "methods/shared/raycast/grid_raycast.h"

namespace dustbench::grid_fluid {

struct GridFluidSettings {
    FluidSetup setup;
    fluid::FluidSettings solver;  ///< its box without a place
    SolverBackend solverBackend = SolverBackend::cpu;
    int framesPerStep = 1;
    std::uint64_t seed = 1;
    raycast::RaycastSettings picture;
};

class GridFluid final : public Method {
 public:
    explicit GridFluid(GridFluidSettings settings);

    void prepare(const scene::Scene& scene, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    [[nodiscard]] std::optional<double> massKept(const Frame& frame) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;
    [[nodiscard]] std::optional<std::uint64_t> stateHash() const override;
    [[nodiscard]] std::optional<FlowExtremes> flow() const override { return flow_; }
    [[nodiscard]] bool wantsPreroll() const override { return true; }

    [[nodiscard]] const FlowSolver& solver() const { return *solver_; }
    /// ∫ extinction dV.
    [[nodiscard]] double opticalMassSquareMetres() const;

 private:
    void simulate(const Frame& frame);
    void placeSolids(const scene::SceneState& state);
    void requireSourcesInside(const scene::SceneState& state);
    void show();

    GridFluidSettings settings_;
    const scene::Scene* scene_ = nullptr;
    MemoryLedger ledger_;
    LedgerVector<float> density_, reaction_;         ///< as the picture wants them
    gpu::Texture densityTexture_, reactionTexture_;  ///< the same where they stay on the GPU
    std::optional<FlowSolver> solver_;
    std::optional<FluidSolids> solids_;
    std::optional<Emitters> emitters_;
    std::optional<raycast::GridRaycast> picture_;
    bool solidsStandStill_ = false;  ///< and are known to the solver
    int framesDue_ = 0;
    double secondsDue_ = 0, dustDueM2_ = 0;
    std::int64_t steps_ = 0;
    FlowExtremes flow_;
};

/// What the method declares; the registry asks for it.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::grid_fluid
