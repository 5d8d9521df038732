// Computes the fraction of the sun's light within a grid that is on the GPU: LightVolume's GPU counterpart.
//
// Units: cells of the shown grid. Owns: its textures. Threads: the OpenGL thread.
// Source: Fedkiw2001; Senger2009 refers to it for light and shadow.
#pragma once

#include <optional>

#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/raycast/raycast_settings.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

class LightOnGpu {
 public:
    /// `toSun`: in world coordinates.
    LightOnGpu(gpu::Device& device, const RaycastSettings& settings, const glm::vec3& toSun);

    void set(const ShownTextures& grid);

    [[nodiscard]] const gpu::Texture& texture() const { return light_; }
    /// Number of cells that the light's texels cover.
    [[nodiscard]] const glm::ivec3& cells() const { return cells_; }
    [[nodiscard]] std::size_t gpuBytes() const { return averages_.bytes() + light_.bytes() + fire_.bytes(); }

 private:
    gpu::Device& device_;
    RaycastSettings settings_;
    gpu::Program march_;
    std::optional<gpu::Program> averageSmoke_, averageFire_;  ///< compiled on first use
    gpu::Texture averages_, light_, fire_;
    glm::ivec3 cells_{0};
};

}  // namespace dustbench::raycast
