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

std::map<std::string, std::string> lineDefinitions(const LineStyle& style) {
    std::map<std::string, std::string> names;
    if (style.additive) names["ADDITIVE"] = "";
    if (style.fade) names["FADE"] = "";
    return names;
}

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

Lines::Lines(gpu::Device& device, const LineStyle& style)
    : InstanceBatch(device, {"lines",
                             draw_shaders::lines_vert,
                             draw_shaders::lines_frag,
                             {},
                             2,
                             1,
                             lineDefinitions(style),
                             gpu::Primitives::lines}),
      style_(style) {}

void Lines::draw(const scene::View& view, const gpu::Layer& layer) {
    if (count() == 0) return;
    gpu::Program& program = this->program(view);
    program.set("seconds", style_.seconds);
    drawWithinScene(program, view, layer);
}

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
