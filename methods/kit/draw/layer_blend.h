// Puts layers over one another: pictures that were drawn into separate buffers into a method's layer, and the layer
// over the opaque scene.
//
// Additive light has no alpha: premultiplied, it is (C, 0), so the scene behind it remains visible. If it is added
// directly to a layer, it is clamped only when the frame is displayed, together with the scene, so bright ground hides
// it sooner than dark ground. Drawn into a separate buffer and clamped to 1 there, as in the thesis, it is the same
// light over any scene. Source: Thesis, 4.1.1 (separate buffer, clamped), 4.1.6 (accumulation), 4.1.8 (two eyes). Owns:
// programs. Threads: the OpenGL thread. Colours: premultiplied, linear RGB.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

enum class Eye { left, right };

/// Throws std::invalid_argument if source and target differ in size.
class DUSTBENCH_API LayerBlend {
 public:
    explicit LayerBlend(gpu::Device& device);

    /// T ← S + (1 − α_S)·T
    void over(const gpu::Texture& source, const gpu::Layer& target);
    /// T ← T + weight·S, every channel; `clamped`: min(S, 1) instead of S.
    void add(const gpu::Texture& source, const gpu::Layer& target, float weight, bool clamped);
    /// The picture of one eye, for red-green glasses: adds the luminance of S (Rec. 709) to the green of T for the left
    /// eye and to its red for the right eye; each eye covers half.
    void addEye(const gpu::Texture& source, const gpu::Layer& target, Eye eye);

 private:
    void blend(const gpu::Texture& source, const gpu::Layer& target, const glm::mat4& mixing, float limit,
               gpu::Blend blend);

    gpu::Program program_;
    gpu::VertexArray noVertices_;
};

/// An intermediate layer with the same depth as another one.
class DUSTBENCH_API OwnLayer {
 public:
    explicit OwnLayer(gpu::Device& device) : device_(&device) {}

    /// Cleared to 0, with the size and depth of `target`. Valid until the next call.
    [[nodiscard]] gpu::Layer& clearedLike(const gpu::Layer& target);
    [[nodiscard]] std::size_t gpuBytes() const { return layer_ ? layer_->colour().bytes() : 0; }

 private:
    gpu::Device* device_;
    std::optional<gpu::Layer> layer_;
    std::uint32_t depthName_ = 0;
};

/// Composites a method's layer over the opaque scene and encodes the result for display: the last step of a frame.
class DUSTBENCH_API Composite {
 public:
    Composite(gpu::Device& device, int width, int height);
    ~Composite();
    Composite(const Composite&) = delete;
    Composite& operator=(const Composite&) = delete;

    /// result() has this size from now on.
    void resize(int width, int height);

    /// sRGB( layer + (1 − α_layer)·scene ) into result().
    void draw(const gpu::Texture& scene, const gpu::Texture& layer);

    [[nodiscard]] const gpu::Texture& result() const;  ///< RGBA8, display-encoded

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace dustbench::draw
