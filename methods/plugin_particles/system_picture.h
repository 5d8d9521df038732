// Draws one system's particles as its render part specifies.
//
// Additive light is drawn into its own buffer and clamped there (kit/draw/layer_blend.h), unless the part is set
// otherwise. For red-green glasses everything is drawn once per eye; the opaque scene is still that of a single eye in
// the middle. Owns: the pass, the buffers and the drawing order. Threads: the OpenGL thread. Source: Thesis, 4.1.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "methods/contract/memory_report.h"
#include "methods/contract/stage_clock.h"
#include "methods/kit/draw/depth_sort.h"
#include "methods/kit/draw/gpu_depth_order.h"
#include "methods/kit/draw/layer_blend.h"
#include "methods/plugin_particles/shape_pass.h"

namespace dustbench::plugin_particles {

/// Returns the view of one of two eyes, `eyesMetres` apart; both look in the same direction.
[[nodiscard]] scene::View seenBy(draw::Eye eye, const scene::View& view, float eyesMetres);

class SystemPicture {
 public:
    /// Throws InputError if a picture or a mesh cannot be read.
    SystemPicture(gpu::Device& device, const particles::Look& look, const scene::Lights& lights);

    struct Moment {
        const Puffs& puffs;
        glm::vec3 eye;
        float stepSeconds;
    };
    /// Sorts, if needed, and uploads the particles.
    void upload(const Moment& moment, const StageClock& clock);
    /// The same for particles on the GPU.
    void gather(const GpuPuffs& puffs, const glm::vec3& eye, const StageClock& clock);
    /// Draws the last upload; may be called repeatedly.
    void draw(const scene::View& view, const gpu::Layer& layer);

    [[nodiscard]] const particles::Look& look() const { return look_; }
    /// Returns the number of primitives that the last `draw` submitted.
    [[nodiscard]] std::size_t count() const { return pass_->count() * (look_.stereo ? 2 : 1); }
    [[nodiscard]] MemoryReport memory() const;

 private:
    [[nodiscard]] bool isAdditive() const { return look_.blending == particles::Blending::additive; }
    void drawForEye(const scene::View& view, const gpu::Layer& layer);

    gpu::Device& device_;
    particles::Look look_;
    MemoryLedger ledger_;
    draw::DepthSort sort_;
    std::optional<draw::GpuDepthOrder> gpuOrder_;  ///< made for the first particles on the GPU
    std::unique_ptr<ShapePass> pass_;
    std::optional<draw::LayerBlend> blend_;
    draw::OwnLayer light_, oneEye_, bothEyes_;
};

}  // namespace dustbench::plugin_particles
