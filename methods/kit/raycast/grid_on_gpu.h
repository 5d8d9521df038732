// A grid in textures, as the shaders of grid_optics.glsl look into it.
//
// Owns: the textures. Threads: the OpenGL thread's.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/raycast/light_on_gpu.h"
#include "methods/kit/raycast/light_volume.h"
#include "methods/kit/raycast/raycast_settings.h"

namespace dustbench::raycast {

class GridOnGpu {
 public:
    GridOnGpu(gpu::Device& device, const RaycastSettings& settings) : device_(device), settings_(settings) {}

    /// `light`: null where the cloud casts no shadow on itself.
    void upload(const ShownGrid& grid, const LightVolume* light);
    /// Takes what is there already. `light`: null likewise.
    void take(const ShownTextures& grid, const LightOnGpu* light);

    [[nodiscard]] bool burning() const { return burning_; }
    [[nodiscard]] std::map<std::string, std::string> definitions() const;
    /// To texture units 1, 3, 4 and 5, and what the program must know of it.
    void bind(gpu::Program& program, const Reflected& reflected) const;

    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    void takePlace(const glm::ivec3& cells, double spacingMetres, bool burning);

    gpu::Device& device_;
    RaycastSettings settings_;
    gpu::Texture density_, reaction_, fire_, light_;
    /// What is looked into where it is somebody else's.
    const gpu::Texture *takenDensity_ = nullptr, *takenReaction_ = nullptr, *takenLight_ = nullptr;
    glm::ivec3 cells_{0}, lightCells_{0};
    float extinctionPerCell_ = 0;
    bool burning_ = false;
};

/// The transfer function, and what shaders must know of it.
[[nodiscard]] gpu::Texture makeFireTable(gpu::Device& device, const RaycastSettings& settings);
[[nodiscard]] std::map<std::string, std::string> fireDefinitions();

/// Runs a program with groups of 4×4×4 threads, one for each texel.
void dispatchForTexels(const gpu::Program& program, const glm::ivec3& texels);

/// Makes a 3D texture anew where it has not the size already.
void fitTexture(gpu::Texture& texture, gpu::Device& device, const char* label, gpu::Format format,
                const glm::ivec3& size, gpu::Filter filter);

}  // namespace dustbench::raycast
