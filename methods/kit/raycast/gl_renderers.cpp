#include "methods/kit/raycast/gl_renderers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/raycast/shown_grid.h"
#include "raycast_shaders.h"

namespace dustbench::raycast {
namespace {

/// A box's corners in camera axes: right, up, and along the camera's axis.
std::array<glm::vec3, 8> cornersOf(const glm::ivec3& minimum, const glm::ivec3& maximum, const PixelRays& rays) {
    const float pixel = glm::length(rays.right);
    const glm::vec3 right = rays.right / pixel, up = rays.up / pixel, along = glm::cross(up, right);
    std::array<glm::vec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 at =
            glm::vec3(i & 1 ? maximum.x : minimum.x, i & 2 ? maximum.y : minimum.y, i & 4 ? maximum.z : minimum.z) -
            rays.eye;
        corners[static_cast<std::size_t>(i)] = {glm::dot(at, right), glm::dot(at, up), glm::dot(at, along)};
    }
    return corners;
}

/// Bounding rectangle of the box's section with a plane perpendicular to the view: left bottom right top, as lengths
/// over distance.
glm::vec4 sectionOf(const std::array<glm::vec3, 8>& corners, float distance) {
    glm::vec2 low(1e9f), high(-1e9f);
    for (std::size_t i = 0; i < 8; ++i)
        for (const std::size_t axis : {1u, 2u, 4u}) {
            const glm::vec3 &a = corners[i], &b = corners[i ^ axis];
            if ((a.z < distance) == (b.z < distance)) continue;
            const glm::vec2 at = glm::mix(glm::vec2(a), glm::vec2(b), (distance - a.z) / (b.z - a.z)) / distance;
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
    return {low, high};
}

}  // namespace

GlMarch::GlMarch(gpu::Device& device, const RaycastSettings& settings, const Reflected& reflected)
    : device_(device),
      settings_(settings),
      reflected_(reflected),
      grid_(device, settings),
      vertices_(device),
      programs_(std::make_shared<SmokeAndFire>()) {}

GlMarch::GlMarch(Beside, const GlMarch& sibling)
    : device_(sibling.device_),
      settings_(sibling.settings_),
      reflected_(sibling.reflected_),
      grid_(device_, settings_),
      vertices_(device_),
      programs_(sibling.programs_) {}

std::unique_ptr<GridRenderer> GlMarch::another() const {
    return std::make_unique<GlMarch>(Beside(), *this);
}

void GlMarch::upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) {
    grid_.upload(grid, light);
    if (!settings_.skipEmpty) return;
    minimum_ = bricks.minimum();
    maximum_ = bricks.maximum();
    fitTexture(bricks_, device_, "ray cast bricks", gpu::Format::r8, bricks.bricks(), gpu::Filter::nearest);
    bricks_.write(bricks.occupied());
    takenBricks_ = nullptr;
}

void GlMarch::take(const ShownTextures& grid, const BricksOnGpu& bricks, const LightOnGpu* light) {
    grid_.take(grid, light);
    minimum_ = bricks.minimum();
    maximum_ = bricks.maximum();
    takenBricks_ = &bricks.texture();
}

gpu::Program& GlMarch::program() {
    std::optional<gpu::Program>& made = grid_.burning() ? programs_->withFire : programs_->smokeAlone;
    if (!made) {
        std::map<std::string, std::string> definitions = grid_.definitions();
        if (settings_.jitter) definitions["JITTER"] = "";
        if (settings_.skipEmpty) {
            definitions["SKIP"] = "";
            definitions["BRICK"] = std::to_string(BrickMap::edge);
        }
        made.emplace(
            device_, "grid march",
            std::initializer_list<gpu::ShaderFile>{raycast_shaders::grid_optics_glsl, raycast_shaders::rectangle_vert,
                                                   raycast_shaders::grid_march_frag},
            definitions);
    }
    return *made;
}

std::int64_t GlMarch::draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer, SceneDepthCopy&) {
    const PixelRectangle pixels = pixelsOf(place.grid, place.minimum, place.maximum, view);
    if (pixels.empty()) return 0;
    const PixelRays rays(place.grid, view);
    gpu::Program& program = this->program();
    grid_.bind(program, reflected_, place.thickness);
    if (settings_.skipEmpty) {
        program.set("minimum", glm::vec3(minimum_));
        program.set("maximum", glm::vec3(maximum_));
        (takenBricks_ ? *takenBricks_ : bricks_).bind(2);
    }
    program.set("eye", rays.eye);
    program.set("rayCorner", rays.corner);
    program.set("rayRight", rays.right);
    program.set("rayUp", rays.up);
    program.set("nearDistance", rays.nearDistance);
    program.set("stepLength", static_cast<float>(settings_.stepCells));
    program.set("opaqueDepth", opaqueDepth(settings_));
    program.set("rectangle", pixels.inClipSpace(layer.width(), layer.height()));

    gpu::DrawState state;
    state.blend = gpu::Blend::premultiplied;
    layer.bindColourOnly();
    layer.sceneDepth().bind(0);
    gpu::draw(program, vertices_, state, gpu::Primitives::triangleStrip, 4);
    return pixels.count();
}

GlSlices::GlSlices(gpu::Device& device, const RaycastSettings& settings, const Reflected& reflected)
    : device_(device),
      settings_(settings),
      reflected_(reflected),
      grid_(device, settings),
      vertices_(device),
      programs_(std::make_shared<SmokeAndFire>()) {}

GlSlices::GlSlices(Beside, const GlSlices& sibling)
    : device_(sibling.device_),
      settings_(sibling.settings_),
      reflected_(sibling.reflected_),
      grid_(device_, settings_),
      vertices_(device_),
      programs_(sibling.programs_) {}

std::unique_ptr<GridRenderer> GlSlices::another() const {
    return std::make_unique<GlSlices>(Beside(), *this);
}

void GlSlices::upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) {
    grid_.upload(grid, light);
    minimum_ = settings_.skipEmpty ? bricks.minimum() : glm::ivec3(0);
    maximum_ = settings_.skipEmpty ? bricks.maximum() : grid.cells;
}

void GlSlices::take(const ShownTextures& grid, const BricksOnGpu& bricks, const LightOnGpu* light) {
    grid_.take(grid, light);
    minimum_ = settings_.skipEmpty ? bricks.minimum() : glm::ivec3(0);
    maximum_ = settings_.skipEmpty ? bricks.maximum() : grid.cells;
}

gpu::Program& GlSlices::program() {
    std::optional<gpu::Program>& made = grid_.burning() ? programs_->withFire : programs_->smokeAlone;
    if (!made)
        made.emplace(
            device_, "grid slices",
            std::initializer_list<gpu::ShaderFile>{raycast_shaders::grid_optics_glsl, raycast_shaders::grid_slices_vert,
                                                   raycast_shaders::grid_slices_frag},
            grid_.definitions());
    return *made;
}

std::int64_t GlSlices::draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer, SceneDepthCopy&) {
    const PixelRays rays(place.grid, view);
    const std::array<glm::vec3, 8> corners = cornersOf(minimum_, maximum_, rays);
    const auto nearer = [](const glm::vec3& a, const glm::vec3& b) { return a.z < b.z; };
    const auto step = static_cast<float>(settings_.stepCells);
    // Planes are at (i + ½)·step along the camera's axis.
    const int first =
        static_cast<int>(std::ceil(std::max(std::ranges::min_element(corners, nearer)->z, 0.0f) / step - 0.5f));
    const int last = static_cast<int>(std::floor(std::ranges::max_element(corners, nearer)->z / step - 0.5f));
    if (last < first) return 0;
    const auto focal = static_cast<float>(1 / std::tan(view.camera.verticalFieldOfView / 2));
    const glm::vec2 scale(focal * static_cast<float>(view.height) / static_cast<float>(view.width), focal);
    std::vector<glm::vec4> slices;
    for (int i = last; i >= first; --i)
        slices.push_back(glm::vec4(scale, scale) * sectionOf(corners, (static_cast<float>(i) + 0.5f) * step));
    if (slices_.bytes() < slices.size() * sizeof(glm::vec4))
        slices_ = gpu::Buffer(device_, "grid slices", slices.size() * sizeof(glm::vec4));
    slices_.write(std::span<const glm::vec4>(slices));

    gpu::Program& program = this->program();
    grid_.bind(program, reflected_, place.thickness);
    program.set("eye", rays.eye);
    program.set("rayCorner", rays.corner);
    program.set("rayRight", rays.right);
    program.set("rayUp", rays.up);
    program.set("nearDistance", rays.nearDistance);
    program.set("stepLength", step);
    program.set("last", last);
    gpu::DrawState state;
    state.blend = gpu::Blend::premultiplied;
    layer.bindColourOnly();
    layer.sceneDepth().bind(0);
    slices_.bindStorage(0);
    gpu::draw(program, vertices_, state, gpu::Primitives::triangleStrip, 4, static_cast<int>(slices.size()));
    return static_cast<std::int64_t>(slices.size());
}

}  // namespace dustbench::raycast
