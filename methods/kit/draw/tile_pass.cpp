#include "methods/kit/draw/tile_pass.h"

#include <utility>

#include "draw_shaders.h"

namespace dustbench::draw {

TilePass::TilePass(gpu::Device& device, std::string name, std::vector<gpu::ShaderFile> files,
                   std::map<std::string, std::string> definitions, double reachDeviations)
    : device_(device),
      name_(std::move(name)),
      files_(std::move(files)),
      definitions_(std::move(definitions)),
      reach_(reachDeviations),
      loops_(device) {
    files_.insert(files_.begin(), {draw_shaders::error_function_glsl, draw_shaders::puff_ray_glsl,
                                   draw_shaders::loop_limit_glsl, draw_shaders::tile_pass_glsl});
}

gpu::Program& TilePass::begin(const PuffQuads& puffs, const Frame& frame) {
    const std::pair kind{puffs.isColoured(), puffs.isGathered()};
    auto made = programs_.find(kind);
    if (made == programs_.end()) {
        std::map<std::string, std::string> definitions = definitions_;
        definitions["FLOATS"] = std::to_string(puffs.floats());
        if (puffs.isColoured()) definitions["COLOURED"] = "";
        if (puffs.isGathered()) definitions["COUNT_ON_GPU"] = "";
        made = programs_.emplace(kind, gpu::Program(device_, name_, files_, definitions)).first;
    }
    gpu::Program& program = made->second;
    const scene::View& view = frame.view;
    const glm::mat4 clip = view.eyeToClip();
    const glm::vec2 slopes(1 / clip[0][0], 1 / clip[1][1]);  // at the picture's edges
    program.set("rays", glm::vec4(2.0f * slopes / glm::vec2(view.width, view.height), -slopes));
    program.set("nearMetres", static_cast<float>(view.camera.nearMetres));
    program.set("reach", static_cast<float>(reach_));
    program.set("eye", glm::vec3(view.camera.eye));
    program.set("worldToEye", view.worldToEye());
    if (!puffs.isGathered()) program.set("count", static_cast<int>(puffs.count()));
    if (!puffs.isColoured() && !definitions_.contains("COLOURLESS")) program.set("colourOfAll", frame.dust.colourOfAll);
    return program;
}

void TilePass::run(const PuffQuads& puffs, gpu::Program& program, const gpu::Layer& layer) {
    constexpr int tilePixels = 8;
    const auto tiles = [](int pixels) { return (pixels + tilePixels - 1) / tilePixels; };
    puffs.bindValues(0);
    loops_.bind(program);
    if (puffs.isGathered()) puffs.bindNumber(7);
    layer.sceneDepth().bind(0);
    layer.colour().bindImage(0, false, true);
    program.dispatch(tiles(layer.width()), tiles(layer.height()), 1);
}

}  // namespace dustbench::draw
