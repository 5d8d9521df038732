// Draws a shape's particles as points, lines, sprites or billboards.
//
// Owns: the passes and their textures. Threads: the OpenGL thread's. Source: JuckelBeckhaus2007, 4.4.
#pragma once

#include <optional>
#include <span>

#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/lines.h"
#include "methods/kit/draw/points.h"
#include "methods/voxel_shape/particles/shape_particles.h"
#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {

class ShapePicture {
 public:
    ShapePicture(gpu::Device& device, const Look& look);

    /// Copies the particles to the GPU in this order.
    void upload(const ShapeParticles& particles, std::span<const std::uint32_t> order);
    /// Draws the last upload; may be called repeatedly.
    void draw(const scene::View& view, const gpu::Layer& layer);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    Look look_;
    std::optional<draw::PuffTextures> pictures_;
    std::optional<draw::Billboards> billboards_;
    std::optional<draw::Points> points_;
    std::optional<draw::Lines> lines_;
    std::size_t count_ = 0;
};

}  // namespace dustbench::voxel_shape
