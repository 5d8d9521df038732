#include "methods/kit/draw/puff_quads.h"

#include <algorithm>

#include "draw_shaders.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::draw {
namespace {

constexpr std::size_t quadsAtOnce = 64;

}  // namespace

FragmentPass puffPass(const char* name, std::vector<gpu::ShaderFile> files,
                      std::map<std::string, std::string> definitions) {
    files.insert(files.begin(),
                 {draw_shaders::error_function_glsl, draw_shaders::puff_ray_glsl, draw_shaders::puff_quad_glsl});
    return {name, std::move(files), std::move(definitions)};
}

PuffQuads::PuffQuads(gpu::Device& device, double reachDeviations)
    : InstanceBatch(device, {"puff quads", draw_shaders::puff_quads_vert, {}, {0, 1, 2, 2, 1, 3}, 4, quadsAtOnce}),
      reach_(reachDeviations) {}

void PuffQuads::upload(const Puffs& dust) {
    const bool coloured = !dust.uniformColour;
    const std::size_t floats = coloured ? 8 : 5;
    const std::span<float> memory = map(dust.size(), {floats, coloured});
    parallel::forEachBlock(dust.size(), 16'384, [&](std::size_t first, std::size_t count) {
        float* value = memory.data() + first * floats;
        for (std::size_t i = first; i < first + count; ++i) {
            *value++ = dust.x[i];
            *value++ = dust.y[i];
            *value++ = dust.z[i];
            *value++ = dust.radius[i];
            *value++ = dust.opacity[i];
            if (coloured) {
                *value++ = dust.red[i];
                *value++ = dust.green[i];
                *value++ = dust.blue[i];
            }
        }
    });
    unmap();
}

gpu::Program& PuffQuads::begin(FragmentPass& pass, const scene::View& view) {
    gpu::Program& program = this->program(view, pass);
    const glm::mat4 clip = view.eyeToClip();
    program.set("projection", glm::vec4(clip[0][0], clip[1][1], view.camera.nearMetres, reach_));
    const glm::vec2 slopes(1 / clip[0][0], 1 / clip[1][1]);  // at the picture's edges
    program.set("rays", glm::vec4(2.0f * slopes / glm::vec2(view.width, view.height), -slopes));
    program.set("nearMetres", static_cast<float>(view.camera.nearMetres));
    return program;
}

void PuffQuads::add(const gpu::Program& program, const gpu::Texture& sceneDepth) {
    if (count() == 0) return;
    sceneDepth.bind(0);
    gpu::DrawState state;
    state.blend = gpu::Blend::additive;
    drawInstances(program, state);
}

void PuffQuads::addAndReveal(const gpu::Program& program, const gpu::Texture& sceneDepth) {
    if (count() == 0) return;
    sceneDepth.bind(0);
    gpu::DrawState state;
    state.blend = gpu::Blend::additive;
    state.blendOfOutput1 = gpu::Blend::revealing;
    drawInstances(program, state);
}

void PuffQuads::store(const gpu::Program& program, const gpu::Texture& sceneDepth) {
    if (count() == 0) return;
    sceneDepth.bind(0);
    gpu::DrawState state;
    state.storesToBuffers = true;
    drawInstances(program, state);
}

}  // namespace dustbench::draw
