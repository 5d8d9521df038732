#include "methods/kit/draw/tile_puffs.h"

#include <span>

#include "draw_shaders.h"

namespace dustbench::draw {
namespace {

std::vector<gpu::ShaderFile> placesOfPuffs() {
    return {draw_shaders::puff_quad_glsl, draw_shaders::quad_pixels_glsl, draw_shaders::puff_pixels_glsl};
}

gpu::Program addingProgram(gpu::Device& device, const char* name, const std::vector<gpu::ShaderFile>& files,
                           const std::map<std::string, std::string>& definitions) {
    std::vector<gpu::ShaderFile> all{draw_shaders::error_function_glsl, draw_shaders::puff_ray_glsl,
                                     draw_shaders::loop_limit_glsl, draw_shaders::tile_pyramid_glsl,
                                     draw_shaders::tile_shapes_glsl};
    for (const gpu::ShaderFile& file : placesOfPuffs()) all.push_back(file);
    for (const gpu::ShaderFile& file : files) all.push_back(file);
    return {device, std::string(name) + " in tiles", std::span<const gpu::ShaderFile>(all), definitions};
}

}  // namespace

TilePuffs::TilePuffs(gpu::Device& device, const char* name, const std::vector<gpu::ShaderFile>& files,
                     const std::map<std::string, std::string>& definitions, double reachDeviations)
    : reach_(reachDeviations),
      lists_(device, name, placesOfPuffs()),
      add_(addingProgram(device, name, files, definitions)),
      loops_(device) {}

void TilePuffs::prepare(gpu::Program& program, const PuffQuads& puffs, const scene::View& view) const {
    const glm::mat4 clip = view.eyeToClip();
    program.set("projection", glm::vec3(clip[0][0], clip[1][1], view.camera.nearMetres));
    program.set("eye", glm::vec3(view.camera.eye));
    program.set("worldToEye", view.worldToEye());
    program.set("floats", static_cast<int>(puffs.floats()));
    program.set("reach", static_cast<float>(reach_));
    puffs.bindValues(0);
}

gpu::Program& TilePuffs::begin(const PuffQuads& puffs, const scene::View& view, const gpu::Layer& layer,
                               const StageClock& clock) {
    {
        const auto detail = clock.measureDetail("bin");
        lists_.build({static_cast<std::uint32_t>(puffs.count()), puffs.countOnGpu()}, layer.width(), layer.height(),
                     [&](gpu::Program& program) { prepare(program, puffs, view); });
    }
    lists_.describe(add_);
    prepare(add_, puffs, view);
    const glm::mat4 clip = view.eyeToClip();
    const glm::vec2 slopes(1 / clip[0][0], 1 / clip[1][1]);  // at the picture's edges
    add_.set("rays", glm::vec4(2.0f * slopes / glm::vec2(view.width, view.height), -slopes));
    return add_;
}

void TilePuffs::run(const gpu::Layer& layer, const StageClock& clock) {
    const auto detail = clock.measureDetail("blend");
    lists_.bind();
    loops_.bind(add_);
    layer.sceneDepth().bind(0);
    layer.colour().bindImage(0, false, true);
    add_.dispatch(lists_.columns(), lists_.rows(), 1);
}

}  // namespace dustbench::draw
