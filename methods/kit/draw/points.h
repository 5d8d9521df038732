// Particles as points or point sprites, one vertex each, all in one draw call.
//
// A point is a flat square of opacity α; a sprite is round, α(b) = 1 − exp(−τ·exp(−b²/2s²)) out to b = 3s, as a
// billboard is, at a fraction of its cost. Either is as wide as a number of pixels says, or as the particle is at its
// distance (half-side 1.5 r = 3s); none is wider than 255 pixels, nor narrower than one. The sprite's picture is a
// billboard's near the middle of the view; away from it, perspective is left out.
//
// Units: m, pixels. Frame: world. Colours: linear RGB. Owns: the instances, on the GPU. Threads: the OpenGL thread's.
// Source: JuckelBeckhaus2007, 4.4.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/view.h"
#include "methods/kit/draw/instance_batch.h"
#include "methods/kit/gpu/layer.h"

namespace dustbench::draw {

struct PointStyle {
    bool sprite = false;
    float pixels = 0;       ///< wide; 0: as large as each particle is
    bool additive = false;  ///< as BillboardStyle has it
};

class DUSTBENCH_API Points : public InstanceBatch {
 public:
    Points(gpu::Device& device, const PointStyle& style);

    /// x y z radius opacity red green blue
    [[nodiscard]] static InstanceLayout layout() { return {8, true}; }

    /// Draws what was mapped last, as often as wanted.
    void draw(const scene::View& view, const gpu::Layer& layer);

 private:
    PointStyle style_;
};

}  // namespace dustbench::draw
