// Ray casting of a sparse grid on the GPU, with the shader for dense grids (kit/raycast/grid_march.frag).
//
// The trees of density and fire are stored in one storage buffer, which PNanoVDB.h reads. Owns: that buffer. Threads:
// the OpenGL thread. Source: Museth2021.
#pragma once

#include <memory>
#include <optional>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/vertex_array.h"
#include "methods/kit/raycast/optics_on_gpu.h"
#include "methods/kit/raycast/pixel_rays.h"
#include "methods/volume/sparse/sparse_moment.h"

namespace dustbench::volume {

class GlSparseMarch {
 public:
    GlSparseMarch(gpu::Device& device, const raycast::RaycastSettings& settings);

    /// `light`: null if the cloud casts no shadow on itself. Throws InputError if the trees exceed the maximum size of
    /// a storage buffer.
    void upload(const SparseMoment& moment, const raycast::LightVolume* light);
    /// Draws the moment uploaded last at these pixels.
    void draw(const SparseMoment& moment, const raycast::PixelRectangle& pixels, const raycast::Reflected& reflected,
              const scene::View& view, const gpu::Layer& layer);

    [[nodiscard]] std::size_t gpuBytes() const { return trees_.bytes() + optics_.gpuBytes(); }

 private:
    [[nodiscard]] gpu::Program& program();

    gpu::Device& device_;
    raycast::RaycastSettings settings_;
    raycast::OpticsOnGpu optics_;
    gpu::Buffer trees_;
    gpu::VertexArray vertices_;
    std::optional<gpu::Program> smokeAlone_, withFire_;  ///< compiled on first use
};

/// Throws InputError if trees of `treeBytes` in total do not fit a storage buffer of `maximumBytes`.
void requireTreesFit(std::size_t treeBytes, std::size_t maximumBytes);

}  // namespace dustbench::volume
