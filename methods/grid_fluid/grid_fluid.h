// Smoke, fire and dust as a fluid: an Eulerian solver in a box, whose density is rendered by ray casting.
//
// The box may follow the vehicle; solids, the vehicle and the ground are voxelised in each step. The wheels raise as
// much dust as the shared cloud gains (emitters.h).
//
// Source: Senger2009, 4 (after Crane2007). Departs: reports/decisions/0006-fluid-grid.md.
#pragma once

#include <memory>
#include <optional>

#include "methods/contract/method.h"
#include "methods/grid_fluid/emitters.h"
#include "methods/grid_fluid/flow_solver.h"
#include "methods/grid_fluid/fluid_setup.h"
#include "methods/grid_fluid/fluid_solids.h"
#include "methods/grid_fluid/trail/fluid_trail.h"
#include "methods/grid_fluid/trail_picture.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/raycast/grid_raycast.h"

namespace dustbench::grid_fluid {

struct GridFluidSettings {
    FluidSetup setup;
    flow::FluidSettings solver;  ///< the position of its box is not set yet
    FlowScheme scheme = FlowScheme::ours;
    SolverBackend solverBackend = SolverBackend::cpu;
    int framesPerStep = 1;
    double proxyCells = 0;  ///< of FluidSolids
    bool trail = true;      ///< keeps the dust that leaves a box that follows the vehicle
    raycast::RaycastSettings picture;
};

/// Over all steps so far.
struct FlowExtremes {
    double speedMetresPerSecond = 0;
    double cellsPerStep = 0;         ///< the Courant number
    double divergencePerStep = 0;    ///< maximum relative volume gain of a cell in a step
    std::int64_t unsolvedSteps = 0;  ///< steps in which the pressure solver ran out of cycles
};

class GridFluid final : public Method {
 public:
    explicit GridFluid(GridFluidSettings settings);

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;
    [[nodiscard]] std::optional<std::uint64_t> stateHash() const override;
    [[nodiscard]] bool wantsPreroll() const override { return true; }

    /// ∫ extinction dV, of box and trail.
    [[nodiscard]] double opticalMassSquareMetres() const;

 private:
    void simulate(const Frame& frame);
    /// True if the pressure is solved to a tolerance, false if by a fixed number of sweeps.
    [[nodiscard]] bool solvesPressure() const {
        return settings_.scheme == FlowScheme::ours && settings_.solver.pressure == flow::PressureMethod::multigrid;
    }
    /// Optical mass of the fluid relative to that of the shared dust; empty if the box does not follow the vehicle.
    [[nodiscard]] std::optional<double> massKept(const Puffs& dust) const;
    /// Grid-scale noise of the stored values (flow/grid_noise.h).
    [[nodiscard]] double noiseOf(flow::Lane lane) const;
    /// Σ density·volume, of box and trail.
    [[nodiscard]] double amountM3() const;
    /// Relative error of the mass in box and trail: missing from, or in excess of, the mass raised by the sources that
    /// has not died of age. Empty without a trail, or if the sources' mass is unknown.
    [[nodiscard]] std::optional<double> massLost() const;
    void follow(const scene::VehicleState& vehicle);
    void placeSolids(const scene::SceneState& state);
    void requireSourcesInside(const scene::SceneState& state);
    /// Density or reaction for display: values that corrections without a limit pull below 0 become 0.
    void gatherSeen(flow::Lane lane, std::span<float> to) const;
    void show();
    void volumeOfTrail(VolumeVisitor& visitor) const;

    GridFluidSettings settings_;
    const scene::Scene* scene_ = nullptr;
    MemoryLedger ledger_;
    LedgerVector<float> density_, reaction_;         ///< for the ray caster
    gpu::Texture densityTexture_, reactionTexture_;  ///< the same if they stay on the GPU
    std::unique_ptr<flow::Solver> solver_;
    std::optional<flow_gl::CellsOnRays> rays_;  ///< if the fluid is solved on the GPU
    std::optional<FluidSolids> solids_;
    std::optional<Emitters> emitters_;
    std::optional<raycast::GridRaycast> picture_;
    std::optional<FluidTrail> trail_;
    std::optional<TrailPicture> trailPicture_;
    bool solidsStandStill_ = false;  ///< and the solver already has the solids
    int framesDue_ = 0;
    double secondsDue_ = 0, dustDueM2_ = 0;
    std::int64_t steps_ = 0;
    FlowExtremes extremes_;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::grid_fluid
