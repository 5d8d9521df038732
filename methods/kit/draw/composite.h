// Composites a method's layer over the opaque scene and encodes the result for display: the last step of a frame.
#pragma once

#include <memory>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

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
