#include "methods/kit/draw/billboards.h"

#include <map>
#include <string>
#include <vector>

#include "draw_shaders.h"

namespace dustbench::draw {
namespace {

constexpr std::size_t puffsAtOnce = 64;

std::map<std::string, std::string> billboardDefinitions(const BillboardStyle& style, const PuffTextures* pictures) {
    std::map<std::string, std::string> names;
    if (style.facing == Facing::viewplane) names["VIEWPLANE"] = "";
    if (style.soft) names["SOFT"] = "";
    if (style.plainAlpha) names["PLAIN_ALPHA"] = "";
    if (style.additive) names["ADDITIVE"] = "";
    if (style.moving) names["MOVING"] = "";
    if (style.noise > 0) names["NOISY"] = "";
    if (pictures) names["TEXTURED"] = "";
    if (pictures && pictures->crossFaded()) names["CROSS_FADED"] = "";
    return names;
}

std::vector<gpu::ShaderFile> billboardPieces(const BillboardStyle& style) {
    std::vector<gpu::ShaderFile> pieces{draw_shaders::error_function_glsl, draw_shaders::billboard_quad_glsl};
    if (style.noise > 0) pieces.push_back(draw_shaders::gradient_noise_glsl);
    return pieces;
}

}  // namespace

Billboards::Billboards(gpu::Device& device, const BillboardStyle& style, const PuffTextures* pictures)
    : InstanceBatch(device, {"billboards",
                             draw_shaders::billboards_vert,
                             draw_shaders::billboards_frag,
                             {0, 1, 2, 2, 1, 3},
                             4,
                             puffsAtOnce,
                             billboardDefinitions(style, pictures),
                             gpu::Primitives::triangles,
                             billboardPieces(style)}),
      style_(style),
      pictures_(pictures) {}

void Billboards::drawCopy(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer,
                          const Copy& copy) {
    if (count() == 0) return;
    const glm::mat4 eyeToClip = view.eyeToClip();
    gpu::Program& program = this->program(view);
    program.set("projection", glm::vec4(eyeToClip[0][0], eyeToClip[1][1], view.camera.nearMetres,
                                        pictures_ ? pictures_->opticalDepthScale() : 1.0f));
    if (!layoutOfAll().coloured) program.set("puffColour", colourOfAll);
    if (style_.moving) {
        program.set("back", copy.back);
        program.set("share", copy.share);
    }
    if (noisy()) program.set("noise", style_.noise);
    if (pictures_) {
        program.set("shadeScale", pictures_->shadeScale());
        pictures_->texture().bind(0);
    }

    gpu::DrawState state;
    state.blend = gpu::Blend::premultiplied;
    if (style_.soft) {
        program.set("nearMetres", static_cast<float>(view.camera.nearMetres));
        layer.bindColourOnly();
        layer.sceneDepth().bind(1);
    } else {
        state.depthTest = true;
        layer.bindWithSceneDepth();
    }
    drawInstances(program, state);
}

}  // namespace dustbench::draw
