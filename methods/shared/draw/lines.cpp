#include "methods/shared/draw/lines.h"

#include <map>
#include <string>

#include "draw_shaders.h"

namespace dustbench::draw {
namespace {

std::map<std::string, std::string> definitions(const LineStyle& style) {
    if (style.additive) return {{"ADDITIVE", ""}};
    return {};
}

}  // namespace

Lines::Lines(gpu::Device& device, const LineStyle& style)
    : InstanceBatch(device, {"lines",
                             draw_shaders::lines_vert,
                             draw_shaders::lines_frag,
                             {},
                             2,
                             1,
                             definitions(style),
                             gpu::Primitives::lines}),
      style_(style) {}

void Lines::draw(const scene::View& view, const gpu::Layer& layer) {
    if (count() == 0) return;
    const glm::mat4 eyeToClip = view.eyeToClip();
    gpu::Program& program = this->program(view);
    program.set("projection", glm::vec3(eyeToClip[0][0], eyeToClip[1][1], view.camera.nearMetres));
    program.set("seconds", style_.seconds);
    gpu::DrawState state;
    state.blend = gpu::Blend::premultiplied;
    state.depthTest = true;
    layer.bindWithSceneDepth();
    drawInstances(program, state);
}

}  // namespace dustbench::draw
