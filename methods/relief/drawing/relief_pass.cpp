#include "methods/relief/drawing/relief_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <stdexcept>
#include <string>

#include "draw_shaders.h"
#include "methods/kit/draw/ground_pass.h"
#include "methods/kit/draw/panel_pass.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/meshes/curved_panel.h"
#include "relief_drawing_shaders.h"

namespace dustbench::relief {
namespace {

constexpr int texels = 512;  // 12 mm each, as in the opaque scene

/// Appends the two triangles of a quadrilateral a, b, c, d.
void quadrilateral(std::vector<std::uint32_t>& indices, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                   std::uint32_t d) {
    indices.insert(indices.end(), {a, b, c, a, c, d});
}

std::vector<std::uint32_t> indicesOf(std::uint32_t columns, std::uint32_t rows, bool curved) {
    const std::uint32_t bottom = columns * rows, top = (rows - 1) * columns, right = columns - 1;
    std::vector<std::uint32_t> indices;
    const auto grid = [&](std::uint32_t first) {
        for (std::uint32_t row = 0; row + 1 < rows; ++row)
            for (std::uint32_t n = first + row * columns; n < first + row * columns + right; ++n)
                quadrilateral(indices, n, n + 1, n + columns + 1, n + columns);
    };
    grid(0);
    const auto rim = [&](std::uint32_t first, std::uint32_t spacing, std::uint32_t count) {
        for (std::uint32_t k = 0; k + 1 < count; ++k) {
            const std::uint32_t n = first + k * spacing;
            quadrilateral(indices, n, n + spacing, n + spacing + bottom, n + bottom);
        }
    };
    rim(0, 1, columns);
    rim(top, 1, columns);
    rim(0, columns, rows);
    rim(right, columns, rows);
    if (curved)
        grid(bottom);
    else
        quadrilateral(indices, bottom, bottom + right, bottom + top + right, bottom + top);
    return indices;
}

constexpr int stripVertices = 14;

/// Straight pieces of a ray in the frame of a curved relief: its sagitta in the longest ones is a millimetre for 2 m
/// of plate with a radius of 1 m.
constexpr int chords = 24;
constexpr double boxMarginMetres = 1e-3;

std::map<std::string, std::string> definitions(const ReliefStyle& style, const scene::Panel& panel) {
    const scene::Relief& relief = *panel.relief;
    std::map<std::string, std::string> result{{"MOST_BLOCKS", std::to_string(16 * (relief.columns + relief.rows))}};
    if (style.march == March::paper) {
        result.emplace("PAPER_MARCH", "1");
        result.emplace("LINEAR_STEPS", std::to_string(style.linearSteps));
        result.emplace("BINARY_STEPS", std::to_string(style.binarySteps));
    }
    if (meshes::isCurved(panel)) {
        result.emplace("CURVED", "1");
        result.emplace("CHORDS", std::to_string(chords));
    }
    if (style.shadow) result.emplace("SHADOW", "1");
    if (style.carShadow) result.emplace("CAR_SHADOW", "1");
    if (style.dustShadow) result.emplace("DUST", "1");
    return result;
}

std::uint8_t toByte(float share) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f)));
}

gpu::Program programFor(gpu::Device& device, const ReliefStyle& style, const scene::Panel& panel) {
    namespace shaders = relief_drawing_shaders;
    const bool mesh = style.march == March::mesh;
    const std::array files{shaders::relief_face_glsl,
                           shaders::relief_march_glsl,
                           shaders::relief_dust_glsl,
                           draw_shaders::error_function_glsl,
                           draw_shaders::opaque_dust_glsl,
                           shaders::relief_light_glsl,
                           mesh ? shaders::relief_mesh_vert : shaders::relief_vert,
                           mesh ? shaders::relief_mesh_frag : shaders::relief_frag};
    return {device, mesh ? "relief mesh" : "relief", std::span<const gpu::ShaderFile>(files),
            definitions(style, panel)};
}

}  // namespace

CarShadow::CarShadow(gpu::Device& device, const scene::Scene& scene)
    : model_(*scene.vehicle),
      body_(device, model_.body),
      wheel_(device, model_.wheel),
      // The wheels extend slightly beyond the body, below and ahead.
      map_(device, "relief car shadow", texels,
           static_cast<double>(body_.radiusMetres()) + 2 * static_cast<double>(wheel_.radiusMetres()),
           scene.lights.toSun),
      caster_(device, "relief car shadow",
              {relief_drawing_shaders::car_shadow_vert, relief_drawing_shaders::car_shadow_frag}) {}

void CarShadow::draw(const scene::SceneState& state) {
    const scene::VehiclePoses poses = scene::vehiclePoses(model_, state.vehicle);
    map_.aim(glm::dvec3(poses.body.toWorld * glm::vec4(body_.centre(), 1)));
    const glm::mat4 toLight = map_.eyeToLight(glm::dvec3(0));
    const gpu::DrawState casting{.depthTest = true, .depthWrite = true};
    map_.bindAndClear();
    caster_.set("toLight", toLight * poses.body.toWorld);
    body_.draw(caster_, casting);
    for (const scene::SolidPose& pose : poses.wheels) {
        caster_.set("toLight", toLight * pose.toWorld);
        wheel_.draw(caster_, casting);
    }
}

glm::mat4 CarShadow::fromPanel(const glm::dmat4& panelToWorld) const {
    return glm::mat4(glm::dmat4(map_.eyeToTexture(glm::dvec3(0))) * panelToWorld);
}

ReliefMesh::ReliefMesh(gpu::Device& device, int columns, int rows, bool curved)
    : vertices_(device), triangles_(2 * (columns + 1) * (rows + 1), 2 * (columns + 1), 2 * (rows + 1)) {
    const std::vector<std::uint32_t> indices =
        indicesOf(static_cast<std::uint32_t>(columns) + 2, static_cast<std::uint32_t>(rows) + 2, curved);
    indexCount_ = static_cast<int>(indices.size());
    indices_ = gpu::Buffer(device, "relief mesh", std::span<const std::uint32_t>(indices));
    vertices_.indices(indices_);
}

ReliefPass::ReliefPass(gpu::Device& device, const scene::Scene& scene, const scene::Panel& panel,
                       const DepthPyramid& pyramid, const ReliefStyle& style)
    : scene_(scene),
      panel_(panel),
      style_(style),
      program_(programFor(device, style, panel)),
      noVertices_(device),
      depths_(device, "relief depths", panel.relief->depth.size() * sizeof(float)),
      colours_(draw::colourTexture(device, "relief colours", *panel.relief)),
      marks_(gpu::Texture::make2D(device, "relief marks", gpu::Format::rgba8, panel.relief->columns, panel.relief->rows,
                                  gpu::Filter::mipmapped)),
      depthValues_(panel.relief->depth.size()),
      plateColour_(draw::meanColour(*panel.relief)) {
    if (style.march == March::mesh) {
        mesh_.emplace(device, panel.relief->columns, panel.relief->rows, meshes::isCurved(panel));
        program_.set("triangles", mesh_->triangles());
    }
    if (meshes::isCurved(panel)) {
        program_.set("curvature", glm::vec2(panel.curvaturePerMetre));
        if (style.march != March::mesh) {
            const meshes::PlateBounds bounds = meshes::boundsOf(panel);
            program_.set("boxLow", glm::vec3(bounds.low - boxMarginMetres));
            program_.set("boxHigh", glm::vec3(bounds.high + boxMarginMetres));
        }
    }
    if (!marchesBlocks()) return;
    std::vector<glm::ivec4> levels;
    for (const DepthPyramid::Level& level : pyramid.levels())
        levels.emplace_back(static_cast<int>(level.offset), level.columns, level.rows, 0);
    blocks_ = gpu::Buffer(device, "relief pyramid", pyramid.blocks().size_bytes());
    levels_ = gpu::Buffer(device, "relief levels", std::span<const glm::ivec4>(levels));
    program_.set("lastLevel", static_cast<int>(levels.size()) - 1);
}

bool ReliefPass::marchesBlocks() const {
    return style_.march == March::safe || (style_.march == March::mesh && style_.shadow);
}

std::size_t ReliefPass::upload(const WornSurface& surface, const DepthPyramid& pyramid, const TexelRectangle& changed) {
    if (changed.empty()) return 0;
    const std::size_t texels = uploadTexels(surface, changed);
    return marchesBlocks() ? texels + uploadBlocks(pyramid, changed) : texels;
}

std::size_t ReliefPass::uploadTexels(const WornSurface& surface, const TexelRectangle& changed) {
    constexpr float scale = 1.0f / DepthMap::bottom;
    const float markScale = scale / style_.visibleShare;
    const DepthMap& map = surface.depths();
    markValues_.clear();
    for (int row = changed.firstRow; row < changed.endRow; ++row)
        for (int column = changed.firstColumn; column < changed.endColumn; ++column) {
            const std::size_t i = map.texel(column, row);
            depthValues_[i] = static_cast<float>(map.depths()[i]) * scale;
            for (const std::uint8_t mark : {toByte(static_cast<float>(surface.worn()[i]) * markScale),
                                            toByte(static_cast<float>(surface.laid()[i]) * markScale),
                                            toByte(style_.whiteHits && surface.hits()[i] > 0 ? 1.0f : 0.0f)})
                markValues_.push_back(mark);
            markValues_.push_back(0);
        }
    const std::size_t first = map.texel(changed.firstColumn, changed.firstRow);
    const auto depths = std::span<const float>(depthValues_)
                            .subspan(first, map.texel(changed.endColumn - 1, changed.endRow - 1) + 1 - first);
    depths_.writeFrom(first, depths);
    marks_.writeRectangle(changed.firstColumn, changed.firstRow, changed.columns(), changed.rows(), markValues_);
    marks_.makeMipmaps();
    return depths.size_bytes() + markValues_.size();
}

/// The rows of each level that contain a changed block.
std::size_t ReliefPass::uploadBlocks(const DepthPyramid& pyramid, const TexelRectangle& changed) {
    std::size_t bytes = 0;
    for (std::size_t k = 0; k < pyramid.levels().size(); ++k) {
        const DepthPyramid::Level& level = pyramid.levels()[k];
        const TexelRectangle over = DepthPyramid::blocksOver(changed, k);
        const auto columns = static_cast<std::size_t>(level.columns);
        const std::size_t first = level.offset + static_cast<std::size_t>(over.firstRow) * columns;
        const auto blocks = pyramid.blocks().subspan(first, static_cast<std::size_t>(over.rows()) * columns);
        blocks_.writeFrom(first, blocks);
        bytes += blocks.size_bytes();
    }
    return bytes;
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

void ReliefPass::draw(const scene::View& view, const glm::dmat4& panelToWorld, const CarShadow* shadow,
                      const draw::DustShadow* dust) {
    if (style_.carShadow != (shadow != nullptr))
        throw std::invalid_argument("ReliefPass: expected the car's shadow if and only if the style uses it");
    scene::View centred = view;
    centred.camera.eye = glm::dvec3(0);
    centred.camera.target -= view.camera.eye;
    glm::dmat4 panelToEye = panelToWorld;
    panelToEye[3] -= glm::dvec4(view.camera.eye, 0);
    const glm::dvec3 eye = glm::transpose(glm::dmat3(panelToWorld)) * -glm::dvec3(panelToEye[3]);
    const glm::dmat4 panelToClip = glm::dmat4(centred.worldToClip()) * panelToEye;
    program_.set("panelToClip", glm::mat4(panelToClip));
    program_.set("eye", glm::vec3(eye));
    program_.set("pixelAngle", static_cast<float>(2 * std::tan(view.camera.verticalFieldOfView / 2) / view.height));
    program_.set("plate", glm::vec3(panel_.sizeMetres / 2.0, panel_.depthMetres));
    program_.set("texels", glm::vec2(panel_.relief->columns, panel_.relief->rows));
    setLight(panelToWorld);
    if (shadow) {
        program_.set("panelToShadow", shadow->fromPanel(panelToWorld));
        shadow->bind(2);
    }
    if (style_.dustShadow != (dust != nullptr))
        throw std::invalid_argument("ReliefPass: expected the dust's shadow if and only if the style uses it");
    if (dust) {
        const glm::dmat4 turn{glm::dmat3(panelToWorld)};
        program_.set("eyeToDust", dust->eyeToTexture(glm::dvec3(panelToWorld[3])) * glm::mat4(turn));
        dust->columns().bind(5);
    }
    bindSurface();
    const gpu::DrawState opaque{.depthTest = true, .depthWrite = true};
    if (mesh_)
        gpu::drawIndexed(program_, mesh_->vertices(), opaque, gpu::Primitives::triangles, mesh_->indexCount());
    else
        gpu::draw(program_, noVertices_, opaque, gpu::Primitives::triangleStrip, stripVertices);
}

void ReliefPass::bindSurface() {
    depths_.bindStorage(1);
    if (marchesBlocks()) {
        blocks_.bindStorage(2);
        levels_.bindStorage(3);
    }
    colours_.bind(0);
    marks_.bind(1);
}

// As albedoAt of relief.frag.
glm::vec3 ReliefPass::colourOf(const WornSurface& surface, std::size_t texel) const {
    const auto shown = [&](std::uint32_t steps) {
        return std::min(1.0f, static_cast<float>(steps) / DepthMap::bottom / style_.visibleShare);
    };
    const glm::vec3 own = panel_.relief->colour[texel];
    const glm::vec3 worn = glm::mix(own, 1.2f * plateColour_, shown(surface.worn()[texel]));
    const glm::vec3 covered = glm::mix(worn, scene_.dustAlbedo, shown(surface.laid()[texel]));
    return style_.whiteHits && surface.hits()[texel] > 0 ? glm::vec3(1) : covered;
}

std::size_t ReliefPass::gpuBytes() const {
    return (mesh_ ? mesh_->bytes() : 0) + depths_.bytes() + blocks_.bytes() + levels_.bytes() + colours_.bytes() +
           marks_.bytes();
}

SceneWithReliefs::SceneWithReliefs(gpu::Device& device, int width, int height)
    : depth_(gpu::Texture::make2D(device, "scene depth with reliefs", gpu::Format::depth32F, width, height)),
      layer_(device, depth_),
      opaque_(device, "scene with reliefs", &layer_.colour(), &depth_),
      copyDepth_(device, "copy depth",
                 {relief_drawing_shaders::whole_picture_vert, relief_drawing_shaders::copy_depth_frag}),
      copyColour_(device, "copy colour",
                  {relief_drawing_shaders::whole_picture_vert, relief_drawing_shaders::copy_colour_frag}),
      noVertices_(device) {}

void SceneWithReliefs::begin(const gpu::Texture& sceneDepth) {
    opaque_.bind();
    sceneDepth.bind(0);
    gpu::draw(copyDepth_, noVertices_, {.depthWrite = true}, gpu::Primitives::triangles, 3);
}

void SceneWithReliefs::copyTo(gpu::Layer& result) {
    result.bindColourOnly();
    layer_.colour().bind(0);
    gpu::draw(copyColour_, noVertices_, {}, gpu::Primitives::triangles, 3);
}

}  // namespace dustbench::relief
