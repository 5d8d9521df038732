#include "methods/kit/draw/lines.h"

#include <map>
#include <string>

#include "draw_shaders.h"

namespace dustbench::draw {
namespace {

std::map<std::string, std::string> lineDefinitions(const LineStyle& style) {
    std::map<std::string, std::string> names;
    if (style.additive) names["ADDITIVE"] = "";
    if (style.fade) names["FADE"] = "";
    return names;
}

}  // namespace

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

}  // namespace dustbench::draw
