#include "methods/grid_fluid/flow_gl/ghosts_on_gpu.h"

#include <fmt/format.h>

#include <algorithm>

#include "grid_fluid_flow_gl_shaders.h"

namespace dustbench::grid_fluid::flow_gl {

using namespace grid_fluid_flow_gl_shaders;

namespace {

std::map<std::string, std::string> ghostDefinitions(const flow::GhostRule& rule) {
    const glm::vec3& wind = rule.windMetresPerSecond;
    return {{"SIDES", sidesText(rule.sides)},
            {"WIND", fmt::format("vec3({:.9e}, {:.9e}, {:.9e})", wind.x, wind.y, wind.z)}};
}

}  // namespace

GhostsOnGpu::GhostsOnGpu(gpu::Device& device, const glm::ivec3& cells, const flow::GhostRule& rule)
    : cells_(cells),
      ghosts_(device, {grid_glsl, ghosts_comp}, ghostDefinitions(rule)),
      sideFaces_(device, {grid_glsl, side_faces_comp}, ghostDefinitions(rule)) {
    for (Kernel* kernel : {&ghosts_, &sideFaces_}) kernel->set("cells", cells);
    ghosts_.set("noSlip", rule.noSlip ? 1 : 0);
}

void GhostsOnGpu::fill(const CellsOnGpu& state) {
    state.bind(1);
    ghosts_.run({std::max(cells_.x, cells_.y) + 2, std::max(cells_.y, cells_.z) + 2, 6});
}

void GhostsOnGpu::setSideFaces(const CellsOnGpu& state) {
    state.moving.bindStorage(1);
    sideFaces_.run({std::max(cells_.x, cells_.y), std::max(cells_.y, cells_.z), 6});
}

}  // namespace dustbench::grid_fluid::flow_gl
