// Draws translucent axis-aligned cubes, all six faces in one instanced draw call.
//
// A cube of constant extinction has optical depth τ = extinction·edge along an axis. Each face blends with opacity 1 −
// exp(−τ/2), so that a ray through any two faces sees 1 − exp(−τ). This is exact along the axes, too much where a ray
// cuts off a corner and too little along a diagonal, because flat faces do not know path lengths. From inside a cube
// one face is visible. The depth test moves all faces 1/1024 of their distance nearer, so that faces coplanar with
// opaque surfaces, such as flat ground, stay visible. Cubes must be sorted far to near; within a cube, faces turned
// away from the eye come first.
//
// Units: m. Frame: world. Colours: linear RGB. Owns: the instances, on the GPU. Threads: the OpenGL thread.
// Source: Carr2006, 3.5. Departs: uses the six-faced cubes that the paper replaces by billboards; Beer–Lambert opacity.
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

    /// Draws the instances mapped last; may be called repeatedly. `colourOfAll` applies to cubes without own colours.
    void draw(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer);
};

}  // namespace dustbench::draw
