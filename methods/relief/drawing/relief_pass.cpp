#include "methods/relief/drawing/relief_pass.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "methods/kit/draw/ground_pass.h"
#include "methods/kit/draw/panel_pass.h"
#include "methods/kit/gpu/draw_call.h"
#include "relief_drawing_shaders.h"

namespace dustbench::relief {
namespace {

constexpr int stripVertices = 14;

std::map<std::string, std::string> definitions(const ReliefStyle& style, const scene::Relief& relief) {
    std::map<std::string, std::string> result{{"MOST_BLOCKS", std::to_string(16 * (relief.columns + relief.rows))}};
    if (style.march == March::paper) {
        result.emplace("PAPER_MARCH", "1");
        result.emplace("LINEAR_STEPS", std::to_string(style.linearSteps));
        result.emplace("BINARY_STEPS", std::to_string(style.binarySteps));
    }
    if (style.shadow) result.emplace("SHADOW", "1");
    return result;
}

std::uint8_t toByte(float share) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f)));
}

}  // namespace

ReliefPass::ReliefPass(gpu::Device& device, const scene::Scene& scene, const scene::Panel& panel,
                       const DepthPyramid& pyramid, const ReliefStyle& style)
    : scene_(scene),
      panel_(panel),
      style_(style),
      program_(device, "relief",
               {relief_drawing_shaders::relief_march_glsl, relief_drawing_shaders::relief_vert,
                relief_drawing_shaders::relief_frag},
               definitions(style, *panel.relief)),
      noVertices_(device),
      depths_(device, "relief depths", panel.relief->depth.size() * sizeof(float)),
      colours_(draw::colourTexture(device, "relief colours", *panel.relief)),
      marks_(gpu::Texture::make2D(device, "relief marks", gpu::Format::rgba8, panel.relief->columns, panel.relief->rows,
                                  gpu::Filter::mipmapped)),
      depthValues_(panel.relief->depth.size()),
      markValues_(4 * panel.relief->depth.size()),
      plateColour_(draw::meanColour(*panel.relief)) {
    if (style.march == March::paper) return;
    std::vector<glm::ivec4> levels;
    for (const DepthPyramid::Level& level : pyramid.levels())
        levels.emplace_back(static_cast<int>(level.offset), level.columns, level.rows, 0);
    blocks_ = gpu::Buffer(device, "relief pyramid", pyramid.blocks().size_bytes());
    levels_ = gpu::Buffer(device, "relief levels", std::span<const glm::ivec4>(levels));
    program_.set("lastLevel", static_cast<int>(levels.size()) - 1);
}

void ReliefPass::upload(const WornSurface& surface, const DepthPyramid& pyramid, const TexelRectangle& changed) {
    if (changed.empty()) return;
    constexpr float scale = 1.0f / DepthMap::bottom;
    const float markScale = scale / style_.visibleShare;
    const DepthMap& map = surface.depths();
    for (int row = changed.firstRow; row < changed.endRow; ++row)
        for (int column = changed.firstColumn; column < changed.endColumn; ++column) {
            const std::size_t i = map.texel(column, row);
            depthValues_[i] = static_cast<float>(map.depths()[i]) * scale;
            markValues_[4 * i] = toByte(static_cast<float>(surface.worn()[i]) * markScale);
            markValues_[4 * i + 1] = toByte(static_cast<float>(surface.laid()[i]) * markScale);
            markValues_[4 * i + 2] = style_.whiteHits && surface.hits()[i] > 0 ? 255 : 0;
        }
    depths_.write(std::span<const float>(depthValues_));
    marks_.write(markValues_);
    if (style_.march == March::paper) return;
    blocks_.write(pyramid.blocks());
}

void ReliefPass::setLight(const glm::dmat4& panelToWorld) {
    const glm::dmat3 toPanel = glm::transpose(glm::dmat3(panelToWorld));
    const scene::Lights& lights = scene_.lights;
    const glm::vec3 ground =
        draw::GroundPass::albedo(scene_) * (lights.sun * std::max(lights.toSun.y, 0.0f) + lights.ambient);
    program_.set("toSun", glm::vec3(glm::normalize(toPanel * glm::dvec3(lights.toSun))));
    program_.set("worldUp", glm::vec3(toPanel * glm::dvec3(0, 1, 0)));
    program_.set("sun", lights.sun);
    program_.set("ambient", lights.ambient);
    program_.set("groundLight", ground);
    program_.set("haze", lights.skyHorizon);
    program_.set("hazePerMetre", lights.hazePerMetre);
    program_.set("plateColour", plateColour_);
    program_.set("dustColour", scene_.dustAlbedo);
}

void ReliefPass::draw(const scene::View& view, const glm::dmat4& panelToWorld) {
    scene::View centred = view;
    centred.camera.eye = glm::dvec3(0);
    centred.camera.target -= view.camera.eye;
    glm::dmat4 panelToEye = panelToWorld;
    panelToEye[3] -= glm::dvec4(view.camera.eye, 0);
    const glm::dvec3 eye = glm::transpose(glm::dmat3(panelToWorld)) * -glm::dvec3(panelToEye[3]);
    program_.set("panelToClip", glm::mat4(glm::dmat4(centred.worldToClip()) * panelToEye));
    program_.set("eye", glm::vec3(eye));
    program_.set("plate", glm::vec3(panel_.sizeMetres / 2.0, panel_.depthMetres));
    program_.set("texels", glm::vec2(panel_.relief->columns, panel_.relief->rows));
    setLight(panelToWorld);
    depths_.bindStorage(1);
    if (style_.march == March::safe) {
        blocks_.bindStorage(2);
        levels_.bindStorage(3);
    }
    colours_.bind(0);
    marks_.bind(1);
    gpu::draw(program_, noVertices_, {.depthTest = true, .depthWrite = true}, gpu::Primitives::triangleStrip,
              stripVertices);
}

std::size_t ReliefPass::gpuBytes() const {
    return depths_.bytes() + blocks_.bytes() + levels_.bytes() + colours_.bytes() + marks_.bytes();
}

}  // namespace dustbench::relief
