#include "methods/shared/raycast/grid_on_gpu.h"

namespace dustbench::raycast {

void fitTexture(gpu::Texture& texture, gpu::Device& device, const char* label, gpu::Format format,
                const glm::ivec3& size, gpu::Filter filter) {
    if (texture.bytes() > 0 && glm::ivec3(texture.width(), texture.height(), texture.depth()) == size) return;
    texture = gpu::Texture::make3D(device, label, format, size.x, size.y, size.z, filter);
}

void GridOnGpu::upload(const ShownGrid& grid, const LightVolume* light) {
    cells_ = grid.cells;
    extinctionPerCell_ = static_cast<float>(settings_.extinctionPerMetre * grid.spacingMetres);
    burning_ = !grid.reaction.empty();
    fitTexture(density_, device_, "ray cast density", gpu::Format::r32F, cells_, gpu::Filter::linear);
    density_.write(grid.density);
    if (light) {
        fitTexture(light_, device_, "ray cast light", gpu::Format::r32F, light->texels(), gpu::Filter::linear);
        light_.write(light->values());
        lightCells_ = light->texels() * light->texelCells();
    }
    if (!burning_) return;
    fitTexture(reaction_, device_, "ray cast reaction", gpu::Format::r32F, cells_, gpu::Filter::linear);
    reaction_.write(grid.reaction);
    if (fire_.bytes() > 0) return;
    const std::vector<glm::vec4> table = settings_.fire.table();
    fire_ = gpu::Texture::make2D(device_, "ray cast transfer function", gpu::Format::rgba32F, TransferFunction::texels,
                                 1, gpu::Filter::linear);
    fire_.write(std::span<const float>(&table.data()->x, 4 * table.size()));
}

std::map<std::string, std::string> GridOnGpu::definitions() const {
    std::map<std::string, std::string> definitions;
    if (burning_) {
        definitions["FIRE"] = "";
        definitions["FIRE_TEXELS"] = std::to_string(TransferFunction::texels);
    }
    if (settings_.shadowCells > 0) definitions["SHADOW"] = "";
    if (settings_.filter == Filter::cubic) definitions["CUBIC"] = "";
    return definitions;
}

void GridOnGpu::bind(gpu::Program& program, const Reflected& reflected) const {
    program.set("cells", glm::vec3(cells_));
    program.set("extinction", extinctionPerCell_);
    density_.bind(1);
    if (settings_.shadowCells > 0) {
        program.set("reflectedSky", reflected.ambient);
        program.set("reflectedSun", reflected.sun);
        program.set("lightCells", glm::vec3(lightCells_));
        light_.bind(5);
    } else {
        program.set("reflected", reflected.all());
    }
    if (!burning_) return;
    reaction_.bind(3);
    fire_.bind(4);
}

std::size_t GridOnGpu::gpuBytes() const {
    return density_.bytes() + reaction_.bytes() + fire_.bytes() + light_.bytes();
}

}  // namespace dustbench::raycast
