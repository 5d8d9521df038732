// Draws particles as points or point sprites, as lines along their velocity, or as the curves of their paths: one draw
// call each.
//
// Units: m, m/s, s, pixels. Frame: world. Colours: linear RGB. Owns: the instances, on the GPU. Threads: the OpenGL
// thread. Source: JuckelBeckhaus2007, 4.4; Thesis, 4.1.3.
//
// A point is a flat square of opacity α. A sprite is round, α(b) = 1 − exp(−τ·exp(−b²/2s²)) out to b = 3s, like a
// billboard at a fraction of the cost. Sizes are given in pixels, or follow from the particle's radius and distance
// (half-side 1.5 r = 3s); they are limited to 1..255 pixels. Near the middle of the view a sprite matches a billboard;
// away from it, the sprite ignores perspective.
//
// A line is one pixel wide, from each position back along the velocity. So is a curve, through the positions of a
// particle's last steps: between two positions x_k and x_(k+1), k steps back, the path is a cubic (Hermite) with the
// tangents m_k = (x_(k+1) − x_(k−1))/2, at the newest position m_0 = (−3x_0 + 4x_1 − x_2)/2. Under a constant
// acceleration it is the parabola itself. Each step is drawn as `pieces` straight lines.
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

struct LineStyle {
    float seconds = 1.0f / 60;  ///< a line covers the distance travelled in this time
    bool additive = false;      ///< as in BillboardStyle
    bool fade = false;          ///< the opacity falls linearly to 0 at the earlier end
};

class DUSTBENCH_API Lines : public InstanceBatch {
 public:
    Lines(gpu::Device& device, const LineStyle& style);

    /// x y z velocity (3) opacity red green blue
    [[nodiscard]] static InstanceLayout layout() { return {10, true}; }

    /// Draws the instances mapped last; may be called repeatedly.
    void draw(const scene::View& view, const gpu::Layer& layer);

 private:
    LineStyle style_;
};

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
