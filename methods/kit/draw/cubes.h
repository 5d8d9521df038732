// Translucent cubes along the world's axes, their six faces all in one instanced draw call.
//
// A cube of constant extinction has the optical depth τ = extinction·edge along an axis. Each face blends with opacity
// 1 − exp(−τ/2), so that a ray through two of them, whichever two, sees 1 − exp(−τ). That is exact along the axes; it
// is too much where a ray cuts off a corner and too little along a diagonal: flat faces know no lengths. From inside a
// cube one face is seen. Faces that lie in what is solid, as on flat ground, are seen: the depth test takes all for
// 1/1024 of their distance nearer than they are. Cubes come sorted from far to near; within one, faces away from the
// eye come first.
//
// Units: m. Frame: world. Colours: linear RGB. Owns: the instances, on the GPU. Threads: the OpenGL thread's.
// Source: Carr2006, 3.5. Departs: the six-faceted cubes that it sets aside for billboards; opacity by Beer and Lambert.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/view.h"
#include "methods/kit/draw/instance_batch.h"
#include "methods/kit/gpu/layer.h"

namespace dustbench::draw {

class Cubes : public InstanceBatch {
 public:
    explicit Cubes(gpu::Device& device);

    /// x y z of the centre, edge, τ [red green blue]
    [[nodiscard]] static InstanceLayout layout(bool coloured) { return {coloured ? 8u : 5u, coloured}; }

    /// Draws what was mapped last, as often as wanted. `colourOfAll` is for cubes without colours of their own.
    void draw(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer);
};

}  // namespace dustbench::draw
