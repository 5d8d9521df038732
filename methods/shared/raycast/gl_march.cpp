#include "methods/shared/raycast/gl_march.h"

#include <cmath>
#include <map>
#include <string>

#include "methods/shared/gpu/draw_call.h"
#include "raycast_shaders.h"

namespace dustbench::raycast {
namespace {

/// Keeps the texture where it has the size already.
void fit(gpu::Texture& texture, gpu::Device& device, const char* label, gpu::Format format, const glm::ivec3& size,
         gpu::Filter filter) {
    if (texture.bytes() > 0 && texture.width() == size.x && texture.height() == size.y && texture.depth() == size.z)
        return;
    texture = gpu::Texture::make3D(device, label, format, size.x, size.y, size.z, filter);
}

}  // namespace

GlMarch::GlMarch(gpu::Device& device, const RaycastSettings& settings)
    : device_(device), settings_(settings), vertices_(device) {}

void GlMarch::upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) {
    cells_ = grid.cells;
    extinctionPerCell_ = static_cast<float>(settings_.extinctionPerMetre * grid.spacingMetres);
    least_ = bricks.least();
    most_ = bricks.most();
    burning_ = !grid.reaction.empty();
    fit(density_, device_, "ray cast density", gpu::Format::r32F, cells_, gpu::Filter::linear);
    density_.write(grid.density);
    if (settings_.skipEmpty) {
        fit(bricks_, device_, "ray cast bricks", gpu::Format::r8, bricks.bricks(), gpu::Filter::nearest);
        bricks_.write(bricks.occupied());
    }
    if (light) {
        fit(light_, device_, "ray cast light", gpu::Format::r32F, light->texels(), gpu::Filter::linear);
        light_.write(light->values());
        lightCells_ = light->texels() * light->texelCells();
    }
    if (!burning_) return;
    fit(reaction_, device_, "ray cast reaction", gpu::Format::r32F, cells_, gpu::Filter::linear);
    reaction_.write(grid.reaction);
    if (fire_.bytes() > 0) return;
    const std::vector<glm::vec4> table = settings_.fire.table();
    fire_ = gpu::Texture::make2D(device_, "ray cast transfer function", gpu::Format::rgba32F, TransferFunction::texels,
                                 1, gpu::Filter::linear);
    fire_.write(std::span<const float>(&table.data()->x, 4 * table.size()));
}

gpu::Program& GlMarch::program() {
    std::optional<gpu::Program>& made = burning_ ? withFire_ : smokeAlone_;
    if (!made) {
        std::map<std::string, std::string> definitions;
        if (burning_) {
            definitions["FIRE"] = "";
            definitions["FIRE_TEXELS"] = std::to_string(TransferFunction::texels);
        }
        if (settings_.shadowCells > 0) definitions["SHADOW"] = "";
        if (settings_.jitter) definitions["JITTER"] = "";
        if (settings_.filter == Filter::cubic) definitions["CUBIC"] = "";
        if (settings_.skipEmpty) {
            definitions["SKIP"] = "";
            definitions["BRICK"] = std::to_string(BrickMap::edge);
        }
        made.emplace(
            device_, "grid march",
            std::initializer_list<gpu::ShaderFile>{raycast_shaders::rectangle_vert, raycast_shaders::grid_march_frag},
            definitions);
    }
    return *made;
}

void GlMarch::draw(const PixelRays& rays, const PixelRectangle& pixels, const Reflected& reflected,
                   const gpu::Layer& layer) {
    gpu::Program& program = this->program();
    program.set("cells", glm::vec3(cells_));
    if (settings_.skipEmpty) {
        program.set("least", glm::vec3(least_));
        program.set("most", glm::vec3(most_));
    }
    program.set("eye", rays.eye);
    program.set("rayCorner", rays.corner);
    program.set("rayRight", rays.right);
    program.set("rayUp", rays.up);
    program.set("nearDistance", rays.nearDistance);
    program.set("stepLength", static_cast<float>(settings_.stepCells));
    program.set("extinction", extinctionPerCell_);
    program.set("opaqueDepth", opaqueDepth(settings_));
    if (settings_.shadowCells > 0) {
        program.set("reflectedSky", reflected.ambient);
        program.set("reflectedSun", reflected.sun);
        program.set("lightCells", glm::vec3(lightCells_));
    } else {
        program.set("reflected", reflected.all());
    }
    program.set("rectangle", pixels.inClipSpace(layer.width(), layer.height()));

    gpu::DrawState state;
    state.blend = gpu::Blend::premultiplied;
    layer.bindColourOnly();
    layer.sceneDepth().bind(0);
    density_.bind(1);
    if (settings_.skipEmpty) bricks_.bind(2);
    if (burning_) {
        reaction_.bind(3);
        fire_.bind(4);
    }
    if (settings_.shadowCells > 0) light_.bind(5);
    gpu::draw(program, vertices_, state, gpu::Primitives::triangleStrip, 4);
}

std::size_t GlMarch::gpuBytes() const {
    return density_.bytes() + reaction_.bytes() + bricks_.bytes() + fire_.bytes() + light_.bytes();
}

}  // namespace dustbench::raycast
