// Adds puffs up per tile in a compute shader, for methods that add a value per puff in any order: what PuffQuads does
// with a fragment shader, without a rasteriser.
//
// A method's compute shader has the functions of tile_shapes.glsl and puff_pixels.glsl, and reads the scene's depth at
// texture unit 0. It writes the layer, image unit 0.
//
// Units: m. Frame: world. Owns: lists of tiles, on the GPU. Threads: the OpenGL thread.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "methods/contract/stage_clock.h"
#include "methods/contract/view.h"
#include "methods/kit/draw/loop_limit.h"
#include "methods/kit/draw/puff_quads.h"
#include "methods/kit/draw/tile_lists.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::draw {

class DUSTBENCH_API TilePuffs {
 public:
    /// `files`: the compute shader and its pieces, in addition to puff_ray.glsl. `reachDeviations`: as for PuffQuads.
    TilePuffs(gpu::Device& device, const char* name, const std::vector<gpu::ShaderFile>& files,
              const std::map<std::string, std::string>& definitions, double reachDeviations);

    /// Lists the puffs that `puffs` holds, for a layer: the stage's detail `bin`. Returns the shader, for its own
    /// uniforms; sets `projection`, `vec4 rays` and those of puff_pixels.glsl.
    [[nodiscard]] gpu::Program& begin(const PuffQuads& puffs, const scene::View& view, const gpu::Layer& layer,
                                      const StageClock& clock);
    /// Runs the shader: the detail `blend`.
    void run(const gpu::Layer& layer, const StageClock& clock);
    /// As LoopLimit's.
    void requireWholeLoops(std::string_view method) const { loops_.requireWholeLoops(method); }
    [[nodiscard]] std::size_t bytes() const { return lists_.bytes(); }

 private:
    void prepare(gpu::Program& program, const PuffQuads& puffs, const scene::View& view) const;

    double reach_;
    TileLists lists_;
    gpu::Program add_;
    LoopLimit loops_;
};

}  // namespace dustbench::draw
