#include "methods/kit/draw/points.h"

#include <map>
#include <string>

#include "draw_shaders.h"

namespace dustbench::draw {
namespace {

std::map<std::string, std::string> pointDefinitions(const PointStyle& style) {
    std::map<std::string, std::string> names;
    if (style.sprite) names["SPRITE"] = "";
    if (style.additive) names["ADDITIVE"] = "";
    return names;
}

}  // namespace

Points::Points(gpu::Device& device, const PointStyle& style)
    : InstanceBatch(device, {"points",
                             draw_shaders::points_vert,
                             draw_shaders::points_frag,
                             {},
                             1,
                             1,
                             pointDefinitions(style),
                             gpu::Primitives::points}),
      style_(style) {}

void Points::draw(const scene::View& view, const gpu::Layer& layer) {
    if (count() == 0) return;
    gpu::Program& program = this->program(view);
    program.set("pixels", style_.pixels);
    program.set("halfHeight", static_cast<float>(view.height) / 2);
    drawWithinScene(program, view, layer);
}

}  // namespace dustbench::draw
