// Puffs as quads, for methods that add a value per puff in any order: fragment shaders get the puff along the pixel's
// ray in closed form, cut at the eye and the scene.
//
// A method's fragment shader reads `flat in vec4 centre; flat in float logDepth;` and, if COLOURED, `flat in vec3
// puffColour`, and calls the functions of puff_ray.glsl. Its outputs are added to the bound sums. Depth 1 − share
// beyond `reach` standard deviations from a puff's centre is not drawn: exp(−reach²/2) of its depth at most.
// A shader that needs the puff's place in the upload reads `flat in int puffIndex;`.
//
// Units: m. Frame: world. Colours: linear RGB. Owns: the instances, on the GPU. Threads: the OpenGL thread; filling
// uses the current oneTBB arena.
#pragma once

#include "methods/contract/view.h"
#include "methods/contract/volume.h"
#include "methods/kit/draw/instance_batch.h"

namespace dustbench::draw {

/// A pass over puffs: a fragment shader and its pieces, in addition to puff_ray.glsl.
[[nodiscard]] DUSTBENCH_API FragmentPass puffPass(const char* name, std::vector<gpu::ShaderFile> files,
                                                  std::map<std::string, std::string> definitions = {});

class DUSTBENCH_API PuffQuads : public InstanceBatch {
 public:
    PuffQuads(gpu::Device& device, double reachDeviations);

    /// Copies the puffs in their order, with their own colours if they have any.
    void upload(const Puffs& dust);
    [[nodiscard]] bool isColoured() const { return layoutOfAll().coloured; }
    /// Floats per puff; a colour is at their end.
    [[nodiscard]] std::size_t floats() const { return layoutOfAll().floats; }

    /// The pass's program, for its own uniforms. Sets those of the quads and `vec4 rays` and `float nearMetres`, from
    /// which `rayOf` of puff_fragment.glsl makes the pixel's ray.
    [[nodiscard]] gpu::Program& begin(FragmentPass& pass, const scene::View& view);
    /// Adds the puffs up in the bound framebuffer. `sceneDepth` is at unit 0.
    void add(const gpu::Program& program, const gpu::Texture& sceneDepth);
    /// Adds output 0, and multiplies what is at output 1 by 1 − its value.
    void addAndReveal(const gpu::Program& program, const gpu::Texture& sceneDepth);
    /// Runs a pass that stores to buffers and discards its fragments. `sceneDepth` is at unit 0.
    void store(const gpu::Program& program, const gpu::Texture& sceneDepth);

 private:
    double reach_;
};

}  // namespace dustbench::draw
