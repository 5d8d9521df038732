// The state of particles in textures, as in the paper: one for position and age, one for velocity. Both are RGBA32F and
// double-buffered: a shader reads the old pair and writes the new one.
//
// Texel n holds particle n of the columns. The shader reads it from its previous texel in the old pair, or from the
// list of newborn particles. This closes gaps, and both movers keep the same order. The collision follows surface_hit.h
// step by step, in double precision.
//
// Units, frame: relief_particles.h. Owns: textures and lists on the GPU. Threads: the OpenGL thread.
// Source: Bergeron, 3.1 and 3.2. Departs: the paper draws into the textures; a compute shader writes them here.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/relief/particles/relief_particles.h"
#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {

class TextureMover final : public Mover {
 public:
    TextureMover(gpu::Device& device, const scene::Panel& panel, const DepthMap& surface);

    /// Copies the texels changed by wear since the last call.
    void upload(const DepthMap& surface, const TexelRectangle& changed);
    /// Moves the textures' particles and copies them into the columns. `surface` must be the one uploaded last.
    void move(const MovingColumns& columns, const DepthMap& surface, const StepSettings& settings) override;

    /// The two textures after the last step, read back. Texels without a particle are 0.
    struct StateCopy {
        int columns, rows;
        std::vector<glm::vec4> places;      ///< w: age in steps
        std::vector<glm::vec4> velocities;  ///< w: Fate; those of ended particles are dropped in the next step
    };
    [[nodiscard]] StateCopy copyState() const;
    /// Texels of the living particles, in the order of the columns.
    [[nodiscard]] std::span<const std::int32_t> living() const { return living_; }

    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    struct State {
        gpu::Texture places, velocities;
    };
    void makeRoom(std::size_t particles);
    void writeSources(const MovingColumns& columns);
    void run(std::size_t particles, const StepSettings& settings);
    void readBack(const MovingColumns& columns);

    gpu::Device& device_;
    gpu::Program program_;
    gpu::Buffer plate_, depths_, sources_, newborns_;
    State now_, next_;
    std::vector<std::int32_t> living_;  ///< texels of the living particles, in order
    std::size_t used_ = 0;              ///< texels written in the last step
};

}  // namespace dustbench::relief
