#include "methods/kit/raycast/gl_march.h"

#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/raycast/pixel_rays.h"
#include "raycast_shaders.h"

namespace dustbench::raycast {

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

}  // namespace dustbench::raycast
