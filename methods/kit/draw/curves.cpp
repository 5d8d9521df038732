#include "methods/kit/draw/curves.h"

#include <map>
#include <string>

#include "draw_shaders.h"

namespace dustbench::draw {
namespace {

std::uint32_t verticesOf(const CurveStyle& style) {
    return 2 * static_cast<std::uint32_t>(style.steps * style.pieces);
}

std::map<std::string, std::string> curveDefinitions(const CurveStyle& style) {
    std::map<std::string, std::string> names{{"VERTICES", std::to_string(verticesOf(style))},
                                             {"STEPS", std::to_string(style.steps)},
                                             {"PIECES", std::to_string(style.pieces)}};
    if (style.additive) names["ADDITIVE"] = "";
    if (style.fade) names["FADE"] = "";
    return names;
}

}  // namespace

Curves::Curves(gpu::Device& device, const CurveStyle& style)
    : InstanceBatch(device, {"curves",
                             draw_shaders::curves_vert,
                             draw_shaders::lines_frag,
                             {},
                             verticesOf(style),
                             1,
                             curveDefinitions(style),
                             gpu::Primitives::lines}),
      style_(style) {}

void Curves::draw(const scene::View& view, const gpu::Layer& layer) {
    if (count() == 0) return;
    drawWithinScene(program(view), view, layer);
}

}  // namespace dustbench::draw
