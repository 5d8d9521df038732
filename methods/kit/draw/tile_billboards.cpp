#include "methods/kit/draw/tile_billboards.h"

#include <map>
#include <stdexcept>
#include <string>

#include "draw_shaders.h"

namespace dustbench::draw {
namespace {

std::map<std::string, std::string> tileDefinitions(const BillboardStyle& style) {
    if (style.moving || style.additive || style.noise > 0)
        throw std::invalid_argument("billboards in tiles: expected billboards without motion, added light and noise");
    std::map<std::string, std::string> names;
    if (style.facing == Facing::viewplane) names["VIEWPLANE"] = "";
    if (style.soft) names["SOFT"] = "";
    if (style.plainAlpha) names["PLAIN_ALPHA"] = "";
    return names;
}

}  // namespace

TileBillboards::TileBillboards(gpu::Device& device, const BillboardStyle& style)
    : lists_(device, "billboards",
             {draw_shaders::billboard_quad_glsl, draw_shaders::quad_pixels_glsl, draw_shaders::billboard_pixels_glsl},
             tileDefinitions(style)),
      blend_(device, "billboards in tiles",
             {draw_shaders::error_function_glsl, draw_shaders::loop_limit_glsl, draw_shaders::tile_pyramid_glsl,
              draw_shaders::tile_shapes_glsl, draw_shaders::billboard_quad_glsl, draw_shaders::quad_pixels_glsl,
              draw_shaders::billboard_pixels_glsl, draw_shaders::billboard_tiles_comp},
             tileDefinitions(style)),
      loops_(device) {}

void TileBillboards::prepare(gpu::Program& program, const Billboards& billboards, const scene::View& view) const {
    const glm::mat4 eyeToClip = view.eyeToClip();
    program.set("projection", glm::vec3(eyeToClip[0][0], eyeToClip[1][1], view.camera.nearMetres));
    program.set("eye", glm::vec3(view.camera.eye));
    program.set("worldToEye", view.worldToEye());
    program.set("floats", static_cast<int>(billboards.layoutOfAll().floats));
    billboards.bindValues(0);
}

void TileBillboards::draw(const Billboards& billboards, const scene::View& view, const glm::vec3& colourOfAll,
                          const gpu::Layer& layer, const StageClock& clock) {
    if (billboards.count() == 0) return;
    {
        const auto detail = clock.measureDetail("bin");
        lists_.build({static_cast<std::uint32_t>(billboards.count()), billboards.countOnGpu()}, layer.width(),
                     layer.height(), [&](gpu::Program& program) { prepare(program, billboards, view); });
    }
    const auto detail = clock.measureDetail("blend");
    lists_.describe(blend_);
    prepare(blend_, billboards, view);
    blend_.set("puffColour", colourOfAll);
    lists_.bind();
    loops_.bind(blend_);
    layer.sceneDepth().bind(0);
    layer.colour().bindImage(0, false, true);
    blend_.dispatch(lists_.columns(), lists_.rows(), 1);
}

}  // namespace dustbench::draw
