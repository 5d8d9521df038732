// Blends pictures that were drawn into buffers of their own into a method's layer.
//
// Light that adds up has no alpha: premultiplied, it is (C, 0), so that the scene behind it stays. Added straight into
// a layer it is clamped only where the frame is displayed, together with the scene: bright ground would hide it earlier
// than dark ground. Drawn into a buffer of its own and clamped to 1 there, as the thesis does, it is the same light
// over any scene. Source: Thesis, 4.1.1 (a buffer of its own, clamped), 4.1.6 (accumulation), 4.1.8 (two eyes). Owns:
// its program. Threads: the OpenGL thread. Colours: premultiplied, linear RGB.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/gpu/vertex_array.h"

namespace dustbench::draw {

enum class Eye { left, right };

/// Source and target have the same size, or std::invalid_argument is thrown.
class DUSTBENCH_API LayerBlend {
 public:
    explicit LayerBlend(gpu::Device& device);

    /// T ← S + (1 − α_S)·T
    void over(const gpu::Texture& source, const gpu::Layer& target);
    /// T ← T + weight·S, every channel; `clamped`: of min(S, 1).
    void add(const gpu::Texture& source, const gpu::Layer& target, float weight, bool clamped);
    /// The picture of one eye, for glasses of red and green: the luminance of S (Rec. 709) is added to the green of T
    /// for the left eye and to its red for the right one; each eye covers half.
    void addEye(const gpu::Texture& source, const gpu::Layer& target, Eye eye);

 private:
    void blend(const gpu::Texture& source, const gpu::Layer& target, const glm::mat4& mixing, float limit,
               gpu::Blend blend);

    gpu::Program program_;
    gpu::VertexArray noVertices_;
};

/// A layer like another one, over the same depth, for pictures on their way there.
class DUSTBENCH_API OwnLayer {
 public:
    explicit OwnLayer(gpu::Device& device) : device_(&device) {}

    /// Cleared to 0; of the size of `target` and over its depth. Valid until the next call.
    [[nodiscard]] gpu::Layer& clearedLike(const gpu::Layer& target);
    [[nodiscard]] std::size_t gpuBytes() const { return layer_ ? layer_->colour().bytes() : 0; }

 private:
    gpu::Device* device_;
    std::optional<gpu::Layer> layer_;
    std::uint32_t depthName_ = 0;
};

}  // namespace dustbench::draw
