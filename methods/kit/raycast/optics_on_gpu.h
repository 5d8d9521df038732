// Inputs of the shaders that use grid_optics.glsl other than densities: fire's table, light, colours.
//
// Owns: its textures. Threads: the OpenGL thread.
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

class DUSTBENCH_API OpticsOnGpu {
 public:
    OpticsOnGpu(gpu::Device& device, const RaycastSettings& settings) : device_(device), settings_(settings) {}

    /// Selects a grid with this cell edge. `light`: null if the cloud casts no shadow on itself.
    void set(double spacingMetres, bool burning, const LightVolume* light);
    /// The same with light that is already on the GPU.
    void take(double spacingMetres, bool burning, const LightOnGpu* light);

    [[nodiscard]] bool burning() const { return burning_; }
    [[nodiscard]] std::map<std::string, std::string> definitions() const;
    /// Binds to texture units 4 and 5, and sets the program's uniforms; `thickness` as in GridPlace.
    void bind(gpu::Program& program, const Reflected& reflected, float thickness) const;

    [[nodiscard]] std::size_t gpuBytes() const { return fire_.bytes() + light_.bytes(); }

 private:
    gpu::Device& device_;
    RaycastSettings settings_;
    gpu::Texture fire_, light_;
    const gpu::Texture* takenLight_ = nullptr;  ///< external, if it was taken
    glm::ivec3 lightCells_{0};
    float extinctionPerCell_ = 0;
    bool burning_ = false;
};

/// The transfer function as a texture, and the definitions that shaders need for it.
[[nodiscard]] gpu::Texture makeFireTable(gpu::Device& device, const RaycastSettings& settings);
[[nodiscard]] std::map<std::string, std::string> fireDefinitions();

/// Runs a program in groups of 4×4×4 threads, one thread per texel.
void dispatchForTexels(const gpu::Program& program, const glm::ivec3& texels);

/// Replaces a 3D texture unless it already has the given size.
void fitTexture(gpu::Texture& texture, gpu::Device& device, const char* label, gpu::Format format,
                const glm::ivec3& size, gpu::Filter filter);

}  // namespace dustbench::raycast
