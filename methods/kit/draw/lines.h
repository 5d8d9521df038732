// Draws particles as lines one pixel wide, from each position back along the velocity, in one draw call.
//
// Units: m, m/s, s. Frame: world. Colours: linear RGB. Owns: the instances, on the GPU. Threads: the OpenGL thread.
// Source: JuckelBeckhaus2007, 4.4; Thesis, 4.1.3 (the faded end).
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/view.h"
#include "methods/kit/draw/instance_batch.h"
#include "methods/kit/gpu/layer.h"

namespace dustbench::draw {

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

}  // namespace dustbench::draw
