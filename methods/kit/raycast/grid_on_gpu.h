// A grid on the GPU for the shaders that use grid_optics.glsl: its cells, its light, the colours of its fire, and the
// bricks that have density.
//
// Units: cells of the shown grid. Owns: the textures. Threads: the OpenGL thread.
// Source: Fedkiw2001 for light and shadow, to which Senger2009 refers.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/raycast/light_volume.h"
#include "methods/kit/raycast/raycast_settings.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

/// Replaces a 3D texture unless it already has the given size.
void fitTexture(gpu::Texture& texture, gpu::Device& device, const char* label, gpu::Format format,
                const glm::ivec3& size, gpu::Filter filter);

/// Computes the fraction of the sun's light within a grid that is on the GPU: LightVolume's GPU counterpart.
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

/// Inputs of the shaders that use grid_optics.glsl other than densities: fire's table, light, colours.
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

/// A grid in textures, with its optics.
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

/// Finds the bricks with density in a grid that is on the GPU: BrickMap's GPU counterpart.
class BricksOnGpu {
 public:
    explicit BricksOnGpu(gpu::Device& device);

    /// `reach`: number of cells that a sample reads beyond its own. Returns false if a density is negative or NaN.
    /// Waits for the GPU, because the host needs the bounding box of all bricks.
    [[nodiscard]] bool set(const ShownTextures& grid, int reach);

    /// 1 or 0 per brick.
    [[nodiscard]] const gpu::Texture& texture() const { return bricks_; }
    [[nodiscard]] bool empty() const { return minimum_.x >= maximum_.x; }
    /// The range [minimum, maximum) of cells contains all occupied bricks.
    [[nodiscard]] const glm::ivec3& minimum() const { return minimum_; }
    [[nodiscard]] const glm::ivec3& maximum() const { return maximum_; }
    [[nodiscard]] std::size_t gpuBytes() const { return bricks_.bytes() + bounds_.bytes(); }

 private:
    gpu::Device& device_;
    gpu::Program program_;
    gpu::Texture bricks_;
    gpu::Buffer bounds_;
    glm::ivec3 minimum_{0}, maximum_{0};
};

}  // namespace dustbench::raycast
