// Draws particles as points or point sprites, one vertex each, in one draw call.
//
// A point is a flat square of opacity α. A sprite is round, α(b) = 1 − exp(−τ·exp(−b²/2s²)) out to b = 3s, like a
// billboard at a fraction of the cost. Sizes are given in pixels, or follow from the particle's radius and distance
// (half-side 1.5 r = 3s); they are limited to 1..255 pixels. Near the middle of the view a sprite matches a billboard;
// away from it, the sprite ignores perspective.
//
// Units: m, pixels. Frame: world. Colours: linear RGB. Owns: the instances, on the GPU. Threads: the OpenGL thread.
// Source: JuckelBeckhaus2007, 4.4.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/view.h"
#include "methods/kit/draw/instance_batch.h"
#include "methods/kit/gpu/layer.h"

namespace dustbench::draw {

struct PointStyle {
    bool sprite = false;
    float pixels = 0;       ///< width; 0: each particle's own size
    bool additive = false;  ///< as in BillboardStyle
};

class DUSTBENCH_API Points : public InstanceBatch {
 public:
    Points(gpu::Device& device, const PointStyle& style);

    /// x y z radius opacity red green blue
    [[nodiscard]] static InstanceLayout layout() { return {8, true}; }

    /// Draws the instances mapped last; may be called repeatedly.
    void draw(const scene::View& view, const gpu::Layer& layer);

 private:
    PointStyle style_;
};

}  // namespace dustbench::draw
