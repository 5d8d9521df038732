#include "methods/shared/raycast/gl_march.h"

#include "methods/shared/gpu/draw_call.h"
#include "raycast_shaders.h"

namespace dustbench::raycast {

GlMarch::GlMarch(gpu::Device& device, const RaycastSettings& settings)
    : device_(device), settings_(settings), grid_(device, settings), vertices_(device) {}

void GlMarch::upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) {
    grid_.upload(grid, light);
    if (!settings_.skipEmpty) return;
    least_ = bricks.least();
    most_ = bricks.most();
    fitTexture(bricks_, device_, "ray cast bricks", gpu::Format::r8, bricks.bricks(), gpu::Filter::nearest);
    bricks_.write(bricks.occupied());
    takenBricks_ = nullptr;
}

void GlMarch::take(const ShownTextures& grid, const BricksOnGpu& bricks, const LightOnGpu* light) {
    grid_.take(grid, light);
    least_ = bricks.least();
    most_ = bricks.most();
    takenBricks_ = &bricks.texture();
}

gpu::Program& GlMarch::program() {
    std::optional<gpu::Program>& made = grid_.burning() ? withFire_ : smokeAlone_;
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

void GlMarch::draw(const PixelRays& rays, const PixelRectangle& pixels, const Reflected& reflected,
                   const gpu::Layer& layer) {
    gpu::Program& program = this->program();
    grid_.bind(program, reflected);
    if (settings_.skipEmpty) {
        program.set("least", glm::vec3(least_));
        program.set("most", glm::vec3(most_));
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
}

}  // namespace dustbench::raycast
