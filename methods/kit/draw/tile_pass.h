// A compute pass over tiles of 8 × 8 pixels: each invocation owns a pixel and visits the puffs that reach into its
// tile, in the order of their upload. In place of a fragment shader with ordered access to its pixel (fragment
// interlock), which OpenGL 4.5 lacks.
//
// A method's shader defines `void visitPuff(TilePuff visited, PixelRay ray)` and calls `visitPuffsOfTile(rayOfPixel())`
// and, at its end, `reportLoops()` (tile_pass.glsl); image unit 0 is the layer's colour. Every tile tests all puffs, 64
// at once.
//
// Units: metres. Frames: puffs in the world, their centres in eye space. Threads: the OpenGL thread.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "methods/kit/draw/loop_limit.h"
#include "methods/kit/draw/puff_quads.h"

namespace dustbench::draw {

class DUSTBENCH_API TilePass {
 public:
    /// With COLOURLESS in `definitions`, the shader does not ask for colours. `name` is the method's, for messages.
    TilePass(gpu::Device& device, std::string name, std::vector<gpu::ShaderFile> files,
             std::map<std::string, std::string> definitions, double reachDeviations);

    /// The program for the puffs uploaded last, compiled on first use, with its uniforms set: for the method's own.
    [[nodiscard]] gpu::Program& begin(const PuffQuads& puffs, const Frame& frame);
    /// Visits the puffs of all tiles of the layer.
    void run(const PuffQuads& puffs, gpu::Program& program, const gpu::Layer& layer);
    /// As LoopLimit's.
    void requireWholeLoops() const { loops_.requireWholeLoops(name_); }

 private:
    gpu::Device& device_;
    std::string name_;
    std::vector<gpu::ShaderFile> files_;
    std::map<std::string, std::string> definitions_;
    double reach_;
    std::map<std::pair<bool, bool>, gpu::Program> programs_;  ///< by colours of their own, and dust on the GPU
    LoopLimit loops_;
};

}  // namespace dustbench::draw
