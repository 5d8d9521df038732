#include "methods/grid_fluid/flow_gl/advection_on_gpu.h"

#include "grid_fluid_flow_gl_shaders.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using namespace grid_fluid_flow_gl_shaders;

std::map<std::string, std::string> predictionOf(const flow::AdvectionRule& rule) {
    if (rule.scheme != flow::AdvectionScheme::macCormack) return {};
    return {{"CORRECTED", ""}};
}

}  // namespace

AdvectionOnGpu::AdvectionOnGpu(gpu::Device& device, const glm::ivec3& cells, flow::AdvectionRule rule)
    : cells_(cells),
      corrected_(rule.scheme == flow::AdvectionScheme::macCormack),
      predict_(device, {grid_glsl, kinds_glsl, sampling_glsl, predict_comp}, predictionOf(rule)),
      correct_(device, {grid_glsl, kinds_glsl, sampling_glsl, correct_comp},
               {{"LIMIT", std::to_string(static_cast<int>(rule.limit))}}) {
    predict_.set("cells", cells);
    correct_.set("cells", cells);
}

void AdvectionOnGpu::advect(const CellsOnGpu& from, const CellsOnGpu& to, const CellsOnGpu& guess,
                            const gpu::Buffer& kinds, const StepReportOnGpu& report, float cellsPerSpeed) {
    kinds.bindStorage(0);
    from.bind(1);
    (corrected_ ? guess : to).bind(3);
    predict_.set("cellsPerSpeed", cellsPerSpeed);
    if (corrected_) to.moving.bindStorage(5);
    predict_.run(cells_);
    if (!corrected_) return;
    to.bind(5);
    report.bind();
    correct_.set("cellsPerSpeed", cellsPerSpeed);
    correct_.run(cells_);
}

}  // namespace dustbench::grid_fluid::flow_gl
