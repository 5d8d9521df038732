#include "methods/grid_fluid/flow_gl/density_on_gpu.h"

#include "grid_fluid_flow_gl_shaders.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using namespace grid_fluid_flow_gl_shaders;

struct Balance {
    double covered, due;
    float scale, unused;
};

int groupsOf(const glm::ivec3& cells) {
    const glm::ivec3 groups = Kernel::groupsFor(Kernel::columnsOf(cells));
    return groups.x * groups.y * groups.z;
}

}  // namespace

DensityOnGpu::DensityOnGpu(gpu::Device& device, const glm::ivec3& cells)
    : cells_(cells),
      groups_(groupsOf(cells)),
      sums_(device, "fluid density", static_cast<std::size_t>(groups_) * sizeof(double)),
      balance_(device, "fluid density", sizeof(Balance)),
      sum_(device, {grid_glsl, kinds_glsl, density_sum_comp}),
      total_(device, {density_total_comp}, {{"GROUP", "128"}}),
      scale_(device, {grid_glsl, density_scale_comp}) {
    balance_.clear();
    sum_.set("cells", cells);
    scale_.set("cells", cells);
    total_.set("count", groups_);
}

void DensityOnGpu::sum(const CellsOnGpu& state, const gpu::Buffer& kinds, int what, float cellsPerSpeed) {
    kinds.bindStorage(0);
    state.moving.bindStorage(1);
    sums_.bindStorage(2);
    balance_.bindStorage(3);
    sum_.set("what", what);
    sum_.set("cellsPerSpeed", cellsPerSpeed);
    sum_.run(Kernel::columnsOf(cells_));
    total_.set("what", what);
    total_.runGroups(1);
}

void DensityOnGpu::restore(const CellsOnGpu& state, const gpu::Buffer& kinds) {
    sum(state, kinds, 0, 0);
    scale_.run(cells_);
}

}  // namespace dustbench::grid_fluid::flow_gl
