// A grid in textures, as read by the shaders that use grid_optics.glsl.
//
// Owns: the textures. Threads: the OpenGL thread.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
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

    /// `light`: null if the cloud casts no shadow on itself.
    void upload(const ShownGrid& grid, const LightVolume* light);
    /// Uses existing textures. `light`: null if the cloud casts no shadow on itself.
    void take(const ShownTextures& grid, const LightOnGpu* light);

    [[nodiscard]] bool burning() const { return burning_; }
    [[nodiscard]] std::map<std::string, std::string> definitions() const;
    /// Binds to texture units 1, 3, 4 and 5, and sets the program's uniforms; `thickness` as in GridPlace.
    void bind(gpu::Program& program, const Reflected& reflected, float thickness) const;

    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    void takePlace(const glm::ivec3& cells, double spacingMetres, bool burning);

    gpu::Device& device_;
    RaycastSettings settings_;
    gpu::Texture density_, reaction_, fire_, light_;
    /// External textures in use, if the grid was taken.
    const gpu::Texture *takenDensity_ = nullptr, *takenReaction_ = nullptr, *takenLight_ = nullptr;
    glm::ivec3 cells_{0}, lightCells_{0};
    float extinctionPerCell_ = 0;
    bool burning_ = false;
};

/// The programs of a renderer, compiled on first use.
struct SmokeAndFire {
    std::optional<gpu::Program> smokeAlone, withFire;
};

/// The transfer function, and the definitions that shaders need for it.
[[nodiscard]] gpu::Texture makeFireTable(gpu::Device& device, const RaycastSettings& settings);
[[nodiscard]] std::map<std::string, std::string> fireDefinitions();

/// Runs a program in groups of 4×4×4 threads, one thread per texel.
void dispatchForTexels(const gpu::Program& program, const glm::ivec3& texels);

/// Replaces a 3D texture unless it already has the given size.
void fitTexture(gpu::Texture& texture, gpu::Device& device, const char* label, gpu::Format format,
                const glm::ivec3& size, gpu::Filter filter);

}  // namespace dustbench::raycast
