#include "methods/kit/raycast/light_on_gpu.h"

#include "methods/kit/raycast/grid_on_gpu.h"
#include "raycast_shaders.h"

namespace dustbench::raycast {

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

}  // namespace dustbench::raycast
