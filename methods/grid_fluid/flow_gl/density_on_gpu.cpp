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

/// Layout as in add_density.comp.
struct Added {
    std::int32_t cell;
    float density;
};

std::size_t facesOf(const glm::ivec3& cells) {
    return 2 * static_cast<std::size_t>(cells.x * cells.y + cells.y * cells.z + cells.z * cells.x);
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

ExchangeOnGpu::ExchangeOnGpu(gpu::Device& device, const glm::ivec3& cells)
    : device_(device),
      cells_(cells),
      noted_(facesOf(cells)),
      faces_(device, "fluid exchange", noted_.size() * sizeof(glm::vec2)),
      leaving_(device, {grid_glsl, kinds_glsl, leaving_comp}),
      add_(device, {grid_glsl, add_density_comp}) {
    leaving_.set("cells", cells);
    faces_.clear();
}

void ExchangeOnGpu::noteLeaving(const CellsOnGpu& state, const gpu::Buffer& kinds, float cellsPerSpeed) {
    kinds.bindStorage(0);
    state.moving.bindStorage(1);
    faces_.bindStorage(2);
    leaving_.set("cellsPerSpeed", cellsPerSpeed);
    int first = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int width = cells_[(axis + 1) % 3], height = cells_[(axis + 2) % 3];
        leaving_.set("axis", axis);
        leaving_.set("first", first);
        leaving_.run({width, height, 2});
        first += 2 * width * height;
    }
}

void ExchangeOnGpu::readLeaving(std::vector<flow::LeavingDensity>& leaving) {
    leaving.clear();
    faces_.read(std::span<glm::vec2>(noted_));
    auto face = noted_.begin();
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        for (const bool far : {false, true}) {
            glm::ivec3 cell(0);
            cell[axis] = far ? cells_[axis] - 1 : 0;
            for (cell[c] = 0; cell[c] < cells_[c]; ++cell[c])
                for (cell[b] = 0; cell[b] < cells_[b]; ++cell[b], ++face)
                    if (face->y > 0) leaving.push_back({cell, axis, far, face->x, face->y});
        }
    }
}

void ExchangeOnGpu::add(const CellsOnGpu& state, std::span<const flow::AddedDensity> added) {
    const flow::CellLayout layout(cells_);
    std::vector<Added> list;
    list.reserve(added.size());
    for (const auto& [cell, density] : added)
        list.push_back({static_cast<std::int32_t>(layout.at(cell.x, cell.y, cell.z)), density});
    const std::size_t bytes = list.size() * sizeof(Added);
    if (added_.bytes() < bytes) added_ = gpu::Buffer(device_, "fluid exchange", bytes + bytes / 4);
    added_.write(std::span<const Added>(list));
    state.moving.bindStorage(1);
    added_.bindStorage(2);
    const auto count = static_cast<int>(list.size());
    add_.set("count", count);
    add_.runGroups((count + Kernel::group.x * Kernel::group.y - 1) / (Kernel::group.x * Kernel::group.y));
}

}  // namespace dustbench::grid_fluid::flow_gl
