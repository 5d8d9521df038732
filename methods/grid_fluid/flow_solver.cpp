#include "methods/grid_fluid/flow_solver.h"

#include "methods/grid_fluid/demo/demo_solver.h"
#include "methods/grid_fluid/demo/gl_demo_solver.h"
#include "methods/grid_fluid/flow/fluid_solver.h"
#include "methods/grid_fluid/flow_gl/gl_fluid_solver.h"

namespace dustbench::grid_fluid {

std::unique_ptr<flow::Solver> makeFlowSolver(const flow::FluidSettings& settings, FlowScheme scheme, bool burns,
                                             bool onGpu, gpu::Device& device, MemoryLedger& ledger) {
    if (scheme == FlowScheme::demo) {
        const demo::DemoSettings ofDemo = demo::demoOf(settings, burns);
        if (onGpu) return std::make_unique<demo::GlDemoSolver>(ofDemo, device);
        return std::make_unique<demo::DemoSolver>(ofDemo, ledger);
    }
    if (onGpu) return std::make_unique<flow_gl::GlFluidSolver>(settings, device, ledger);
    return std::make_unique<flow::FluidSolver>(settings, ledger);
}

}  // namespace dustbench::grid_fluid
