#include "methods/kit/raycast/optics_on_gpu.h"

namespace dustbench::raycast {

void fitTexture(gpu::Texture& texture, gpu::Device& device, const char* label, gpu::Format format,
                const glm::ivec3& size, gpu::Filter filter) {
    if (texture.bytes() > 0 && glm::ivec3(texture.width(), texture.height(), texture.depth()) == size) return;
    texture = gpu::Texture::make3D(device, label, format, size.x, size.y, size.z, filter);
}

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

void dispatchForTexels(const gpu::Program& program, const glm::ivec3& texels) {
    const glm::ivec3 groups = (texels + 3) / 4;
    program.dispatch(groups.x, groups.y, groups.z);
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

}  // namespace dustbench::raycast
