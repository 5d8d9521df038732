// Points, lines, and both together.
#include "methods/kit/draw/points.h"
#include "methods/plugin_particles/shape_pass.h"

namespace dustbench::plugin_particles {
namespace {

bool isAdditive(const particles::Look& look) {
    return look.blending == particles::Blending::additive;
}

class PointPass final : public ShapePass {
 public:
    PointPass(gpu::Device& device, const particles::Look& look)
        : points_(device, {.sprite = look.round, .pixels = look.pixels, .additive = isAdditive(look)}) {}

    void upload(const Drawn& drawn) override {
        constexpr std::size_t floats = 8;
        const Puffs& p = drawn.puffs;
        fill(points_.map(p.size(), draw::Points::layout()), floats, drawn, [&](float* value, std::size_t i) {
            const glm::vec3 colour = p.colour(i);
            value[0] = p.x[i], value[1] = p.y[i], value[2] = p.z[i];
            value[3] = p.radius[i], value[4] = p.opacity[i];
            value[5] = colour.r, value[6] = colour.g, value[7] = colour.b;
        });
        points_.unmap();
    }
    void draw(const scene::View& view, const gpu::Layer& layer) override { points_.draw(view, layer); }
    [[nodiscard]] std::size_t count() const override { return points_.count(); }
    [[nodiscard]] std::size_t gpuBytes() const override { return points_.gpuBytes(); }

 private:
    draw::Points points_;
};

class LinePass final : public ShapePass {
 public:
    LinePass(gpu::Device& device, const particles::Look& look)
        : seconds_(look.seconds), lines_(device, {.seconds = 1, .additive = isAdditive(look), .fade = look.fading}) {}

    void upload(const Drawn& drawn) override {
        constexpr std::size_t floats = 10;
        const Puffs& p = drawn.puffs;
        fill(lines_.map(p.size(), draw::Lines::layout()), floats, drawn, [&](float* value, std::size_t i) {
            const glm::vec3 colour = p.colour(i), way = drawn.wayOf(i, seconds_);
            value[0] = p.x[i], value[1] = p.y[i], value[2] = p.z[i];
            value[3] = way.x, value[4] = way.y, value[5] = way.z;
            value[6] = p.opacity[i];
            value[7] = colour.r, value[8] = colour.g, value[9] = colour.b;
        });
        lines_.unmap();
    }
    void draw(const scene::View& view, const gpu::Layer& layer) override { lines_.draw(view, layer); }
    [[nodiscard]] std::size_t count() const override { return lines_.count(); }
    [[nodiscard]] std::size_t gpuBytes() const override { return lines_.gpuBytes(); }

 private:
    float seconds_;
    draw::Lines lines_;
};

class HybridPass final : public ShapePass {
 public:
    HybridPass(gpu::Device& device, const particles::Look& look) : lines_(device, look), points_(device, look) {}

    void upload(const Drawn& drawn) override {
        lines_.upload(drawn);
        points_.upload(drawn);
    }
    void draw(const scene::View& view, const gpu::Layer& layer) override {
        lines_.draw(view, layer);
        points_.draw(view, layer);
    }
    [[nodiscard]] std::size_t count() const override { return lines_.count() + points_.count(); }
    [[nodiscard]] std::size_t gpuBytes() const override { return lines_.gpuBytes() + points_.gpuBytes(); }

 private:
    LinePass lines_;
    PointPass points_;
};

}  // namespace

std::unique_ptr<ShapePass> makePointPass(gpu::Device& device, const particles::Look& look) {
    return std::make_unique<PointPass>(device, look);
}
std::unique_ptr<ShapePass> makeLinePass(gpu::Device& device, const particles::Look& look) {
    return std::make_unique<LinePass>(device, look);
}
std::unique_ptr<ShapePass> makeHybridPass(gpu::Device& device, const particles::Look& look) {
    return std::make_unique<HybridPass>(device, look);
}

}  // namespace dustbench::plugin_particles
