#include "methods/grid_fluid/flow_solver.h"

#include "methods/shared/parallel/for_each_block.h"

namespace dustbench::grid_fluid {
namespace {

constexpr std::size_t rowsInABlock = 64;

}  // namespace

FlowSolver::FlowSolver(const fluid::FluidSettings& settings, bool onGpu, gpu::Device& device, MemoryLedger& ledger) {
    if (onGpu)
        gl_.emplace(settings, device, ledger);
    else
        cpu_.emplace(settings, ledger);
}

void FlowSolver::setSolids(const fluid::SolidMask& mask) {
    gl_ ? gl_->setSolids(mask) : cpu_->setSolids(mask);
}

fluid::StepReport FlowSolver::step(double stepSeconds, std::span<const fluid::FluidSource> sources,
                                   const StageClock& clock) {
    return gl_ ? gl_->step(stepSeconds, sources, clock) : cpu_->step(stepSeconds, sources, clock);
}

void FlowSolver::scroll(glm::ivec3 cells) {
    gl_ ? gl_->scroll(cells) : cpu_->scroll(cells);
}

void FlowSolver::gather(fluid::Lane lane, std::span<float> to) const {
    if (gl_) return gl_->gather(lane, to);
    const fluid::CellLayout& layout = cpu_->layout();
    const auto width = static_cast<std::size_t>(layout.nx);
    parallel::forEachBlock(layout.rows(), rowsInABlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r) {
            const float* record = cpu_->cells().cell(layout.at(0, layout.rowJ(r), layout.rowK(r)));
            for (std::size_t i = 0; i < width; ++i) to[r * width + i] = record[i * fluid::lanes + lane];
        }
    });
}

std::vector<float> FlowSolver::pressuresM2PerS2() const {
    if (gl_) return gl_->pressuresM2PerS2();
    const fluid::CellLayout& layout = cpu_->layout();
    std::vector<float> pressures;
    pressures.reserve(cpu_->box().cellCount());
    for (std::size_t r = 0; r < layout.rows(); ++r)
        for (int i = 0; i < layout.nx; ++i)
            pressures.push_back(cpu_->pressureM2PerS2(i, layout.rowJ(r), layout.rowK(r)));
    return pressures;
}

}  // namespace dustbench::grid_fluid
