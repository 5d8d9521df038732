// Where the method has its fluid solved: on the CPU or on the GPU.
#pragma once

#include <memory>

#include "methods/grid_fluid/flow/solver.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::grid_fluid {

enum class SolverBackend {
    automatic,  ///< the GPU where OpenGL has one, and the picture is made there as well
    cpu,
    openGl,
};

/// `device` and `ledger` must outlive it. Throws InputError where the box or the settings make no sense.
[[nodiscard]] std::unique_ptr<flow::Solver> makeFlowSolver(const flow::FluidSettings& settings, bool onGpu,
                                                           gpu::Device& device, MemoryLedger& ledger);

}  // namespace dustbench::grid_fluid
