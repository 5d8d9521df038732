#include "methods/kit/raycast/grid_on_gpu.h"

#include <array>

#include "methods/kit/raycast/brick_map.h"
#include "raycast_shaders.h"

namespace dustbench::raycast {
namespace {

/// The transfer function as a texture, and the definitions that shaders need for it.
gpu::Texture makeFireTable(gpu::Device& device, const RaycastSettings& settings) {
    const std::vector<glm::vec4> table = settings.fire.table();
    gpu::Texture texture = gpu::Texture::make2D(device, "ray cast transfer function", gpu::Format::rgba32F,
                                                TransferFunction::texels, 1, gpu::Filter::linear);
    texture.write(std::span<const float>(&table.data()->x, 4 * table.size()));
    return texture;
}

std::map<std::string, std::string> fireDefinitions() {
    return {{"FIRE", ""}, {"FIRE_TEXELS", std::to_string(TransferFunction::texels)}};
}

/// Runs a program in groups of 4×4×4 threads, one thread per texel.
void dispatchForTexels(const gpu::Program& program, const glm::ivec3& texels) {
    const glm::ivec3 groups = (texels + 3) / 4;
    program.dispatch(groups.x, groups.y, groups.z);
}

}  // namespace

void fitTexture(gpu::Texture& texture, gpu::Device& device, const char* label, gpu::Format format,
                const glm::ivec3& size, gpu::Filter filter) {
    if (texture.bytes() > 0 && glm::ivec3(texture.width(), texture.height(), texture.depth()) == size) return;
    texture = gpu::Texture::make3D(device, label, format, size.x, size.y, size.z, filter);
}

LightOnGpu::LightOnGpu(gpu::Device& device, const RaycastSettings& settings, const glm::vec3& toSun)
    : device_(device), settings_(settings), march_(device, "grid light", {raycast_shaders::light_march_comp}) {
    march_.set("toSun", glm::normalize(toSun));
}

void LightOnGpu::set(const ShownTextures& grid) {
    const int texelCells = settings_.shadowCells;
    const glm::ivec3 texels = (grid.cells + texelCells - 1) / texelCells;
    cells_ = texels * texelCells;
    for (gpu::Texture* texture : {&averages_, &light_})
        fitTexture(*texture, device_, "ray cast light", gpu::Format::r32F, texels, gpu::Filter::linear);
    std::optional<gpu::Program>& average = grid.reaction ? averageFire_ : averageSmoke_;
    if (grid.reaction) {
        if (fire_.bytes() == 0) fire_ = makeFireTable(device_, settings_);
        grid.reaction->bind(3);
        fire_.bind(4);
    }
    if (!average)
        average.emplace(device_, "grid light average",
                        std::initializer_list<gpu::ShaderFile>{raycast_shaders::light_average_comp},
                        grid.reaction ? fireDefinitions() : std::map<std::string, std::string>());
    average->set("texelCells", texelCells);
    grid.density->bind(1);
    averages_.bindImage(0, false, true);
    dispatchForTexels(*average, texels);

    march_.set("end", glm::vec3(grid.cells) / static_cast<float>(texelCells));
    march_.set("extinction",
               static_cast<float>(settings_.extinctionPerMetre * grid.spacingMetres) * static_cast<float>(texelCells));
    averages_.bind(1);
    light_.bindImage(0, false, true);
    dispatchForTexels(march_, texels);
}

void OpticsOnGpu::take(double spacingMetres, bool burning, const LightOnGpu* light) {
    extinctionPerCell_ = static_cast<float>(settings_.extinctionPerMetre * spacingMetres);
    burning_ = burning;
    takenLight_ = nullptr;
    if (burning_ && fire_.bytes() == 0) fire_ = makeFireTable(device_, settings_);
    if (!light) return;
    takenLight_ = &light->texture();
    lightCells_ = light->cells();
}

void OpticsOnGpu::set(double spacingMetres, bool burning, const LightVolume* light) {
    take(spacingMetres, burning, nullptr);
    if (!light) return;
    fitTexture(light_, device_, "ray cast light", gpu::Format::r32F, light->texels(), gpu::Filter::linear);
    light_.write(light->values());
    lightCells_ = light->texels() * light->texelCells();
}

std::map<std::string, std::string> OpticsOnGpu::definitions() const {
    std::map<std::string, std::string> definitions;
    if (burning_) definitions = fireDefinitions();
    if (settings_.shadowCells > 0) definitions["SHADOW"] = "";
    if (settings_.filter == Filter::nearest) definitions["NEAREST"] = "";
    if (settings_.filter == Filter::cubic) definitions["CUBIC"] = "";
    return definitions;
}

void OpticsOnGpu::bind(gpu::Program& program, const Reflected& reflected, float thickness) const {
    program.set("extinction", extinctionPerCell_ * thickness);
    if (settings_.shadowCells > 0) {
        program.set("reflectedSky", reflected.ambient);
        program.set("reflectedSun", reflected.sun);
        program.set("toSun", reflected.toSun);
        program.set("asymmetry", reflected.asymmetry);
        program.set("lightCells", glm::vec3(lightCells_));
        (takenLight_ ? *takenLight_ : light_).bind(5);
    } else {
        program.set("reflected", reflected.all());
    }
    if (burning_) fire_.bind(4);
}

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

BricksOnGpu::BricksOnGpu(gpu::Device& device)
    : device_(device),
      program_(device, "grid bricks", {raycast_shaders::grid_bricks_comp}, {{"BRICK", std::to_string(BrickMap::edge)}}),
      bounds_(device, "ray cast bricks", 2 * sizeof(glm::ivec4)) {}

bool BricksOnGpu::set(const ShownTextures& grid, int reach) {
    const glm::ivec3 bricks = (grid.cells + BrickMap::edge - 1) / BrickMap::edge;
    fitTexture(bricks_, device_, "ray cast bricks", gpu::Format::r8, bricks, gpu::Filter::nearest);
    std::array<glm::ivec4, 2> bounds{glm::ivec4(bricks, 0), glm::ivec4(0)};
    bounds_.write(std::span<const glm::ivec4>(bounds));
    program_.set("reach", reach);
    bricks_.bindImage(0, false, true);
    grid.density->bind(1);
    bounds_.bindStorage(0);
    dispatchForTexels(program_, bricks);
    bounds_.read(std::span<glm::ivec4>(bounds));
    minimum_ = glm::ivec3(bounds[0]) * BrickMap::edge;
    maximum_ = glm::min(glm::ivec3(bounds[1]) * BrickMap::edge, grid.cells);
    return bounds[1].w == 0;
}

}  // namespace dustbench::raycast
