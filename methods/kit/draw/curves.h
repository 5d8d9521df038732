// Draws the paths of particles as curves one pixel wide, through the positions of their last steps, in one draw call.
//
// Between two positions x_k and x_(k+1), k steps back, the path is a cubic (Hermite) with the tangents
// m_k = (x_(k+1) − x_(k−1))/2, at the newest position m_0 = (−3x_0 + 4x_1 − x_2)/2. Under a constant acceleration it is
// the parabola itself. Each step is drawn as `pieces` straight lines.
//
// Units: m, steps. Frame: world. Colours: linear RGB. Owns: the instances, on the GPU. Threads: the OpenGL thread.
// Source: Thesis, 4.1.3 (the curve that lines approximate).
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/view.h"
#include "methods/kit/draw/instance_batch.h"
#include "methods/kit/gpu/layer.h"

namespace dustbench::draw {

struct CurveStyle {
    int steps = 1;          ///< of the path
    int pieces = 4;         ///< straight lines per step
    bool additive = false;  ///< as in BillboardStyle
    bool fade = false;      ///< the opacity falls linearly to 0 at the oldest end
};

class DUSTBENCH_API Curves : public InstanceBatch {
 public:
    Curves(gpu::Device& device, const CurveStyle& style);

    /// Number of positions that define a path of this many steps: both ends, those in between, and one more for the
    /// last tangent.
    [[nodiscard]] static std::size_t positions(int steps) { return static_cast<std::size_t>(steps) + 2; }

    /// opacity red green blue, steps to draw (a fraction for a path that began within a step), then x y z of each
    /// position, newest first
    [[nodiscard]] InstanceLayout layout() const { return {5 + 3 * positions(style_.steps), true}; }

    /// Draws the instances mapped last; may be called repeatedly.
    void draw(const scene::View& view, const gpu::Layer& layer);

 private:
    CurveStyle style_;
};

}  // namespace dustbench::draw
