// Creates the method's fluid solver, on the CPU or on the GPU.
#pragma once

#include <memory>

#include "methods/grid_fluid/flow/solver.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::grid_fluid {

enum class SolverBackend {
    automatic,  ///< the GPU if OpenGL uses one and the picture is drawn there as well
    cpu,
    openGl,
};

enum class FlowScheme {
    ours,  ///< flow/ and flow_gl/
    demo,  ///< as the published demo: demo/
};

/// With `scheme=demo`, `burns` selects the constants for fire instead of smoke. `device` and `ledger` must outlive the
/// solver. Throws InputError for an invalid box or settings.
[[nodiscard]] std::unique_ptr<flow::Solver> makeFlowSolver(const flow::FluidSettings& settings, FlowScheme scheme,
                                                           bool burns, bool onGpu, gpu::Device& device,
                                                           MemoryLedger& ledger);

}  // namespace dustbench::grid_fluid
