// Curves through the positions of the last steps.
#include "methods/kit/draw/points.h"
#include "methods/plugin_particles/last_positions.h"
#include "methods/plugin_particles/shape_pass.h"

namespace dustbench::plugin_particles {
namespace {

class CurvePass final : public ShapePass {
 public:
    CurvePass(gpu::Device& device, const particles::Look& look)
        : steps_(look.steps),
          positions_(draw::Curves::positions(look.steps)),
          curves_(device, {.steps = look.steps,
                           .pieces = look.pieces,
                           .additive = look.blending == particles::Blending::additive,
                           .fade = look.fading}) {}

    void upload(const Drawn& drawn) override;
    void draw(const scene::View& view, const gpu::Layer& layer) override { curves_.draw(view, layer); }
    [[nodiscard]] std::size_t count() const override { return curves_.count(); }
    [[nodiscard]] std::size_t gpuBytes() const override { return curves_.gpuBytes(); }
    [[nodiscard]] std::size_t cpuBytes() const override { return positions_.bytes(); }

 private:
    /// Number of steps of the path since birth.
    [[nodiscard]] float stepsOf(const Drawn& drawn, std::size_t i) const {
        return std::min(static_cast<float>(steps_), drawn.puffs.age[i] / drawn.stepSeconds);
    }

    int steps_;
    LastPositions positions_;
    draw::Curves curves_;
};

void CurvePass::upload(const Drawn& drawn) {
    const Puffs& p = drawn.puffs;
    positions_.follow(p, drawn.stepSeconds);
    const draw::InstanceLayout layout = curves_.layout();
    fill(curves_.map(p.size(), layout), layout.floats, drawn, [&](float* value, std::size_t i) {
        const glm::vec3 colour = p.colour(i);
        for (const float next : {p.opacity[i], colour.r, colour.g, colour.b, stepsOf(drawn, i)}) *value++ = next;
        for (std::size_t k = 0; k < draw::Curves::positions(steps_); ++k) {
            const glm::vec3 place = positions_.at(i, k);
            for (const float next : {place.x, place.y, place.z}) *value++ = next;
        }
    });
    curves_.unmap();
}

}  // namespace

std::unique_ptr<ShapePass> makeCurvePass(gpu::Device& device, const particles::Look& look) {
    return std::make_unique<CurvePass>(device, look);
}

}  // namespace dustbench::plugin_particles
