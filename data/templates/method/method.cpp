#include <algorithm>
#include <optional>

#include "methods/contract/method.h"
#include "methods/kit/draw/points.h"

namespace dustbench::@ID@ {

class @CLASS@ final : public Method {
 public:
    explicit @CLASS@(float pixels) : style_{.sprite = true, .pixels = pixels} {}

    void prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) override { points_.emplace(device, style_); }
    void update(const Frame& frame) override {
        const auto timing = frame.clock.measure(Stage::upload);
        const Puffs& dust = frame.dust;
        float* value = points_->map(dust.size(), draw::Points::layout()).data();
        for (std::size_t i = 0; i < dust.size(); ++i) {
            const glm::vec3 colour = dust.colour(i);
            for (const float number : {dust.x[i], dust.y[i], dust.z[i], dust.radius[i], dust.opacity[i], colour.r, colour.g, colour.b})
                *value++ = number;
        }
        points_->unmap();
    }
    void draw(const Frame& frame, gpu::Layer& layer) override { points_->draw(frame.view, layer); }

    void volume(const Frame& frame, VolumeVisitor& visitor) const override { visitor.puffs(frame.dust); }
    void report(const Frame& frame, Facts& facts) const override {
        if (frame.dust.empty()) return;
        facts.set("dust_height_max", static_cast<double>(*std::ranges::max_element(frame.dust.y)));
    }
    MemoryReport memory() const override { return {{"@ID@", 0, points_->gpuBytes()}}; }
    std::int64_t primitives() const override { return static_cast<std::int64_t>(points_->count()); }

 private:
    draw::PointStyle style_;
    std::optional<draw::Points> points_;
};

MethodInfo describe() {
    MethodInfo info;
    info.title = "@TITLE@";
    info.summary = "Each dust particle as a round dot of a given width, in no order.";
    info.parameters.real("pixels", 4, 1, 255, "pixels", "width of a dot");
    info.facts = {{"dust_height_max", "m", FactOver::maximumOfFrames, "height of the highest particle: maximum of the recorded frames"}};
    info.create = [](const ParameterValues& values) { return std::make_unique<@CLASS@>(static_cast<float>(values.real("pixels"))); };
    return info;
}

}  // namespace dustbench::@ID@
