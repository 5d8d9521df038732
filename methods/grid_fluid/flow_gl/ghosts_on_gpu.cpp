#include "methods/grid_fluid/flow_gl/ghosts_on_gpu.h"

#include <algorithm>

#include "grid_fluid_flow_gl_shaders.h"

namespace dustbench::grid_fluid::flow_gl {

GhostsOnGpu::GhostsOnGpu(gpu::Device& device, const glm::ivec3& cells, const flow::GhostRule& rule)
    : cells_(cells),
      kernel_(device, {grid_fluid_flow_gl_shaders::grid_glsl, grid_fluid_flow_gl_shaders::ghosts_comp},
              {{"SIDES", sidesText(rule.sides)}}) {
    kernel_.set("cells", cells);
    kernel_.set("wind", rule.windMetresPerSecond);
    kernel_.set("noSlip", rule.noSlip ? 1 : 0);
}

void GhostsOnGpu::fill(const CellsOnGpu& state, flow::GhostUse use) {
    state.bind(1);
    kernel_.set("forFaces", use == flow::GhostUse::faces ? 1 : 0);
    kernel_.run({std::max(cells_.x, cells_.y) + 2, std::max(cells_.y, cells_.z) + 2, 6});
}

}  // namespace dustbench::grid_fluid::flow_gl
