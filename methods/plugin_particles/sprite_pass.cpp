// Puffs and sprites, and sprites that are blurred along their path.
//
// Copy k of n is at (k + 1)/n of the path. It has the weight w_k = 2(k + 1)/(n(n + 1)) if the sprite fades in,
// otherwise 1/n: together the copies have the optical depth, or the light, of one sprite.
#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/layer_blend.h"
#include "methods/kit/files/data_folder.h"
#include "methods/plugin_particles/shape_pass.h"

namespace dustbench::plugin_particles {
namespace {

using particles::AntiAliasing;
using particles::Look;
using particles::Primitive;

std::optional<draw::PuffTextures> picturesOf(gpu::Device& device, const Look& look) {
    if (look.picture.empty()) return std::nullopt;
    return draw::PuffTextures(device, files::findData("puff picture", "textures", look.picture, ".png"),
                              draw::PuffTextures::Frames::separate);
}

draw::BillboardStyle styleOf(const Look& look) {
    return {.facing = look.primitive == Primitive::puff ? draw::Facing::viewpoint : draw::Facing::viewplane,
            .additive = look.blending == particles::Blending::additive,
            .moving = look.primitive == Primitive::movingSprites};
}

class SpritePass final : public ShapePass {
 public:
    SpritePass(gpu::Device& device, const Look& look)
        : look_(look),
          pictures_(picturesOf(device, look)),
          billboards_(device, styleOf(look), pictures_ ? &*pictures_ : nullptr),
          moment_(device),
          mean_(device) {
        if (look.by == AntiAliasing::accumulation) blend_.emplace(device);
    }

    void upload(const Drawn& drawn) override;
    void draw(const scene::View& view, const gpu::Layer& layer) override;
    [[nodiscard]] std::size_t count() const override {
        return billboards_.count() * static_cast<std::size_t>(look_.copies);
    }
    [[nodiscard]] std::size_t gpuBytes() const override {
        return billboards_.gpuBytes() + moment_.gpuBytes() + mean_.gpuBytes() +
               (pictures_ ? pictures_->texture().bytes() : 0);
    }

 private:
    [[nodiscard]] float backOf(int copy) const {
        return 1 - static_cast<float>(copy + 1) / static_cast<float>(look_.copies);
    }
    [[nodiscard]] float shareOf(int copy) const {
        const auto n = static_cast<float>(look_.copies);
        return look_.fading ? 2 * static_cast<float>(copy + 1) / (n * (n + 1)) : 1 / n;
    }
    void drawMean(const scene::View& view, const gpu::Layer& layer);

    Look look_;
    std::optional<draw::PuffTextures> pictures_;
    draw::Billboards billboards_;
    draw::OwnLayer moment_, mean_;
    std::optional<draw::LayerBlend> blend_;
    glm::vec3 colourOfAll_{1};
};

void SpritePass::upload(const Drawn& drawn) {
    const Puffs& p = drawn.puffs;
    colourOfAll_ = p.colourOfAll;
    const draw::InstanceLayout layout = billboards_.layout(!p.uniformColour);
    const std::uint64_t frames = pictures_ ? static_cast<std::uint64_t>(pictures_->frames()) : 1;
    const bool moving = look_.primitive == Primitive::movingSprites;
    fill(billboards_.map(p.size(), layout), layout.floats, drawn, [&](float* value, std::size_t i) {
        for (const float next : {p.x[i], p.y[i], p.z[i], p.radius[i], p.opacity[i]}) *value++ = next;
        if (pictures_) *value++ = static_cast<float>(p.serial[i] % frames);
        if (moving) {
            const glm::vec3 way = drawn.wayOf(i, look_.seconds);
            for (const float next : {way.x, way.y, way.z}) *value++ = next;
        }
        if (layout.coloured)
            for (const float next : {p.red[i], p.green[i], p.blue[i]}) *value++ = next;
    });
    billboards_.unmap();
}

void SpritePass::draw(const scene::View& view, const gpu::Layer& layer) {
    if (look_.primitive != Primitive::movingSprites) return billboards_.draw(view, colourOfAll_, layer);
    if (blend_) return drawMean(view, layer);
    for (int copy = 0; copy < look_.copies; ++copy)
        billboards_.drawCopy(view, colourOfAll_, layer, {backOf(copy), shareOf(copy)});
}

/// Draws the mean of the pictures of all copies.
void SpritePass::drawMean(const scene::View& view, const gpu::Layer& layer) {
    const bool clamped = look_.blending == particles::Blending::additive && look_.clamped;
    const gpu::Layer& mean = mean_.clearedLike(layer);
    for (int copy = 0; copy < look_.copies; ++copy) {
        const gpu::Layer& moment = moment_.clearedLike(layer);
        billboards_.drawCopy(view, colourOfAll_, moment, {backOf(copy), 1});
        blend_->add(moment.colour(), mean, shareOf(copy), clamped);
    }
    blend_->over(mean.colour(), layer);
}

}  // namespace

std::unique_ptr<ShapePass> makeSpritePass(gpu::Device& device, const Look& look) {
    return std::make_unique<SpritePass>(device, look);
}

}  // namespace dustbench::plugin_particles
