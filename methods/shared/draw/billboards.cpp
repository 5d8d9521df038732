#include "methods/shared/draw/billboards.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "draw_shaders.h"
#include "methods/shared/gpu/draw_call.h"

namespace dustbench::draw {
namespace {

/// Quads in one instance. One each costs software rasterisers a run of their vertex pipeline a quad
/// (reports/decisions/0002-billboard-drawing.md).
constexpr std::size_t puffsAtOnce = 64;

gpu::Buffer makeCorners(gpu::Device& device) {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t puff = 0; puff < puffsAtOnce; ++puff)
        for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) corners.push_back(4 * puff + corner);
    return {device, "billboard corners", std::span<const std::uint32_t>(corners)};
}

}  // namespace

Billboards::Billboards(gpu::Device& device, const BillboardStyle& style, const PuffTextures* pictures)
    : device_(device), style_(style), pictures_(pictures), corners_(makeCorners(device)), vertices_(device) {
    vertices_.indices(corners_);
}

Billboards::Layout Billboards::layout(bool coloured) const {
    Layout layout;
    layout.framed = pictures_ != nullptr;
    layout.coloured = coloured;
    layout.floats = 5 + (layout.framed ? 1 : 0) + (layout.coloured ? 3 : 0);
    return layout;
}

std::span<float> Billboards::map(std::size_t count, const Layout& layout) {
    count_ = count;
    layout_ = layout;
    const std::size_t floats = count * layout.floats;
    if (floats == 0) return {};
    if (floats * sizeof(float) > instances_.bytes())
        instances_ = gpu::Buffer(device_, "billboards", (floats + floats / 8) * sizeof(float));
    return {static_cast<float*>(instances_.mapForWriting(floats * sizeof(float))), floats};
}

void Billboards::unmap() {
    if (count_ > 0) instances_.unmap();
}

gpu::Program& Billboards::program() {
    std::optional<gpu::Program>& made = layout_.coloured ? ownColours_ : oneColour_;
    if (!made) {
        std::map<std::string, std::string> definitions{{"PUFFS_AT_ONCE", std::to_string(puffsAtOnce)},
                                                       {"FLOATS", std::to_string(layout_.floats)}};
        if (style_.facing == Facing::viewplane) definitions["VIEWPLANE"] = "";
        if (style_.soft) definitions["SOFT"] = "";
        if (layout_.framed) definitions["TEXTURED"] = "";
        if (pictures_ && pictures_->crossFaded()) definitions["CROSS_FADED"] = "";
        if (layout_.coloured) definitions["COLOURED"] = "";
        made.emplace(
            device_, "billboards",
            std::initializer_list<gpu::ShaderFile>{draw_shaders::billboards_vert, draw_shaders::billboards_frag},
            definitions);
    }
    return *made;
}

void Billboards::draw(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer) {
    if (count_ == 0) return;
    const glm::mat4 eyeToClip = view.eyeToClip();
    gpu::Program& program = this->program();
    program.set("count", static_cast<int>(count_));
    program.set("eye", glm::vec3(view.camera.eye));
    program.set("worldToEye", view.worldToEye());
    program.set("projection", glm::vec4(eyeToClip[0][0], eyeToClip[1][1], view.camera.nearMetres,
                                        pictures_ ? pictures_->opticalDepthScale() : 1.0f));
    if (!layout_.coloured) program.set("puffColour", colourOfAll);
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
    instances_.bindStorage(0);
    gpu::drawIndexed(program, vertices_, state, gpu::Primitives::triangles, static_cast<int>(6 * puffsAtOnce),
                     static_cast<int>((count_ + puffsAtOnce - 1) / puffsAtOnce));
}

}  // namespace dustbench::draw
