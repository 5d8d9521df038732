#include "methods/grid_fluid/flow_gl/advection_on_gpu.h"

#include "grid_fluid_flow_gl_shaders.h"
#include "methods/grid_fluid/flow/evened_corrections.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using namespace grid_fluid_flow_gl_shaders;

std::map<std::string, std::string> correctionOf(const flow::AdvectionRule& rule) {
    return {{"LIMIT", std::to_string(static_cast<int>(rule.limit))},
            {"PATH_TOLERANCE", std::to_string(flow::pathTolerance)}};
}

}  // namespace

AdvectionOnGpu::AdvectionOnGpu(gpu::Device& device, const flow::CellLayout& layout, flow::AdvectionRule rule)
    : cells_(layout.nx, layout.ny, layout.nz),
      corrected_(rule.scheme == flow::AdvectionScheme::macCormack),
      halfway_(device, "fluid paths", layout.padded() * CellsOnGpu::bytesMoving),
      centres_(device, {grid_glsl, centres_comp}),
      findHalfway_(device, {grid_glsl, sampling_glsl, halfway_comp}),
      predict_(device, {grid_glsl, kinds_glsl, sampling_glsl, paths_glsl, predict_comp}),
      correct_(device, {grid_glsl, kinds_glsl, sampling_glsl, paths_glsl, correct_comp}, correctionOf(rule)),
      addCorrections_(device, {grid_glsl, add_corrections_comp},
                      {{"KEPT_OF_SPEEDS", std::to_string(flow::keptOfSpeeds)},
                       {"KEPT_OF_CENTRES", std::to_string(flow::keptOfCentres)}}) {
    for (Kernel* kernel : {&centres_, &findHalfway_, &predict_, &correct_, &addCorrections_})
        kernel->set("cells", cells_);
}

void AdvectionOnGpu::findPaths(const CellsOnGpu& cells, const CellsOnGpu& spare, const StepReportOnGpu& report,
                               float cellsPerSpeed) {
    cells.moving.bindStorage(1);
    spare.moving.bindStorage(5);  // the centres' velocities, until something else is written
    centres_.run(cells_ + 2);
    halfway_.bindStorage(6);
    report.bind();
    findHalfway_.set("cellsPerSpeed", cellsPerSpeed);
    findHalfway_.run(cells_ + 2);
}

void AdvectionOnGpu::advect(CellsOnGpu& cells, CellsOnGpu& spare, const CellsOnGpu& guess, const gpu::Buffer& kinds,
                            const StepReportOnGpu& report, float cellsPerSpeed) {
    findPaths(cells, spare, report, cellsPerSpeed);
    kinds.bindStorage(0);
    cells.bind(1);
    (corrected_ ? guess : spare).bind(3);
    halfway_.bindStorage(5);
    predict_.set("cellsPerSpeed", cellsPerSpeed);
    predict_.run(cells_ + 1);
    if (!corrected_) {
        std::swap(cells, spare);
        return;
    }
    spare.bind(6);
    correct_.set("cellsPerSpeed", cellsPerSpeed);
    correct_.run(cells_);
    addCorrections_.run(cells_);
}

}  // namespace dustbench::grid_fluid::flow_gl
