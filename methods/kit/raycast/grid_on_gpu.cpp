#include "methods/kit/raycast/grid_on_gpu.h"

namespace dustbench::raycast {

void GridOnGpu::upload(const ShownGrid& grid, const LightVolume* light) {
    const bool burning = !grid.reaction.empty();
    optics_.set(grid.spacingMetres, burning, light);
    cells_ = grid.cells;
    takenDensity_ = takenReaction_ = nullptr;
    fitTexture(density_, device_, "ray cast density", gpu::Format::r32F, cells_, gpu::Filter::linear);
    density_.write(grid.density);
    if (!burning) return;
    fitTexture(reaction_, device_, "ray cast reaction", gpu::Format::r32F, cells_, gpu::Filter::linear);
    reaction_.write(grid.reaction);
}

void GridOnGpu::take(const ShownTextures& grid, const LightOnGpu* light) {
    optics_.take(grid.spacingMetres, grid.reaction != nullptr, light);
    cells_ = grid.cells;
    takenDensity_ = grid.density;
    takenReaction_ = grid.reaction;
}

void GridOnGpu::bind(gpu::Program& program, const Reflected& reflected, float thickness) const {
    optics_.bind(program, reflected, thickness);
    program.set("cells", glm::vec3(cells_));
    (takenDensity_ ? *takenDensity_ : density_).bind(1);
    if (burning()) (takenReaction_ ? *takenReaction_ : reaction_).bind(3);
}

std::size_t GridOnGpu::gpuBytes() const {
    return density_.bytes() + reaction_.bytes() + optics_.gpuBytes();
}

}  // namespace dustbench::raycast
