// Draws a sparse volume by ray casting, on the CPU or by OpenGL; the counterpart of GridRaycast for dense volumes.
//
// Units: metres, extinction per metre. Frame: world. Colours: linear RGB. Threads: the OpenGL thread; the CPU march
// runs in parallel.
#pragma once

#include <optional>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/raycast/packet_composite.h"
#include "methods/volume/sparse/gl_sparse_march.h"
#include "methods/volume/sparse/sparse_march.h"

namespace dustbench::volume {

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
