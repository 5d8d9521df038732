// Draws a sparse volume by ray casting, on the CPU or by OpenGL; the counterpart of GridRaycast for dense volumes.
//
// Units: metres, extinction per metre. Frame: world. Colours: linear RGB. Owns: the trees on the GPU. Threads: the
// OpenGL thread; the CPU march runs in parallel. Source: Museth2021.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/raycast/cpu_renderer.h"
#include "methods/kit/raycast/grid_on_gpu.h"
#include "methods/kit/raycast/shown_grid.h"
#include "methods/volume/sparse/nano_tree.h"
#include "methods/volume/sparse/sparse_march.h"

namespace dustbench::volume {

/// Ray casting of a sparse grid on the GPU, with the shader for dense grids (kit/raycast/grid_march.frag). The trees of
/// density and fire are stored in one storage buffer, which PNanoVDB.h reads.
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

/// Throws InputError for settings that sparse volumes do not support.
void requireSparse(const raycast::RaycastSettings& settings);

class SparsePicture {
 public:
    /// `device` and `ledger` must outlive this. Throws InputError for settings out of range.
    SparsePicture(gpu::Device& device, const raycast::RaycastSettings& settings, const scene::Lights& lights,
                  MemoryLedger& ledger);

    /// `moment` must outlive all draws of it.
    void upload(const SparseMoment& moment);
    /// Draws the moment uploaded last; may be called repeatedly.
    void draw(const scene::View& view, const gpu::Layer& layer);

    [[nodiscard]] std::size_t gpuBytes() const;
    /// Number of rays cast by the last draw.
    [[nodiscard]] std::int64_t primitives() const { return primitives_; }

 private:
    raycast::RaycastSettings settings_;
    raycast::Reflected reflected_;
    std::vector<glm::vec4> fire_;
    std::optional<raycast::LightVolume> light_;  ///< empty: no shadow
    std::optional<GlSparseMarch> onGpu_;         ///< empty: on the CPU
    SparseMarch march_;
    raycast::PacketComposite composite_;
    const SparseMoment* moment_ = nullptr;  ///< null: nothing is drawn
    std::int64_t primitives_ = 0;
};

}  // namespace dustbench::volume
