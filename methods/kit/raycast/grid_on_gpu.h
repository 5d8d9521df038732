// A grid in textures for the shaders that use grid_optics.glsl.
//
// Owns: the textures. Threads: the OpenGL thread.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/raycast/optics_on_gpu.h"

namespace dustbench::raycast {

class GridOnGpu {
 public:
    GridOnGpu(gpu::Device& device, const RaycastSettings& settings) : device_(device), optics_(device, settings) {}

    /// `light`: null if the cloud casts no shadow on itself.
    void upload(const ShownGrid& grid, const LightVolume* light);
    /// Uses existing textures. `light`: null if the cloud casts no shadow on itself.
    void take(const ShownTextures& grid, const LightOnGpu* light);

    [[nodiscard]] bool burning() const { return optics_.burning(); }
    [[nodiscard]] std::map<std::string, std::string> definitions() const { return optics_.definitions(); }
    /// Binds to texture units 1, 3, 4 and 5, and sets the program's uniforms; `thickness` as in GridPlace.
    void bind(gpu::Program& program, const Reflected& reflected, float thickness) const;

    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    gpu::Device& device_;
    OpticsOnGpu optics_;
    gpu::Texture density_, reaction_;
    /// External textures in use, if the grid was taken.
    const gpu::Texture *takenDensity_ = nullptr, *takenReaction_ = nullptr;
    glm::ivec3 cells_{0};
};

/// The programs of a renderer, compiled on first use.
struct SmokeAndFire {
    std::optional<gpu::Program> smokeAlone, withFire;
};

}  // namespace dustbench::raycast
