#include "methods/plugin_particles/curve_pass.h"

#include <algorithm>

#include "methods/kit/draw/points.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::plugin_particles {

LastPositions::Places LastPositions::placesBeyond(std::size_t size) const {
    Places places;
    for (std::size_t i = size; i < serial_.size(); ++i) places.emplace(serial_[i], i);
    return places;
}

void LastPositions::resize(std::size_t size) {
    for (Moment& moment : moments_)
        for (std::vector<float>& column : moment) column.resize(size);
}

void LastPositions::move(std::size_t from, std::size_t to) {
    for (Moment& moment : moments_)
        for (std::vector<float>& column : moment) column[to] = column[from];
}

/// x_k = x − k·Δt·v
void LastPositions::begin(const Puffs& puffs, std::size_t i, float stepSeconds) {
    for (std::size_t k = 1; k < moments_.size(); ++k) {
        Moment& moment = moments_[(newest_ + moments_.size() - k) % moments_.size()];
        const float back = static_cast<float>(k) * stepSeconds;
        moment[0][i] = puffs.x[i] - back * puffs.velocityX[i];
        moment[1][i] = puffs.y[i] - back * puffs.velocityY[i];
        moment[2][i] = puffs.z[i] - back * puffs.velocityZ[i];
    }
}

void LastPositions::follow(const Puffs& puffs, float stepSeconds) {
    const std::size_t size = puffs.size(), before = serial_.size();
    const Places moved = placesBeyond(size);
    newest_ = (newest_ + 1) % moments_.size();
    resize(std::max(size, before));
    Moment& now = moments_[newest_];
    parallel::forEachBlock(size, 16'384, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            if (i >= before || serial_[i] != puffs.serial[i]) {
                const auto from = moved.find(puffs.serial[i]);
                if (from != moved.end())
                    move(from->second, i);
                else
                    begin(puffs, i, stepSeconds);
            }
            now[0][i] = puffs.x[i], now[1][i] = puffs.y[i], now[2][i] = puffs.z[i];
        }
    });
    resize(size);
    serial_.assign(puffs.serial.begin(), puffs.serial.end());
}

std::size_t LastPositions::bytes() const {
    std::size_t sum = serial_.capacity() * sizeof(std::uint64_t);
    for (const Moment& moment : moments_)
        for (const std::vector<float>& column : moment) sum += column.capacity() * sizeof(float);
    return sum;
}

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
