#include "bench/claims/lent_context.h"

#include "bench/scene/world.h"

namespace dustbench::bench {
namespace {

class LentWorld final : public ExperimentWorld {
 public:
    LentWorld(const std::string& scene, const ParameterValues& parameters, std::uint64_t seed, int width, int height)
        : world_(scene, "", parameters, seed), width_(width), height_(height) {}

    [[nodiscard]] const scene::Scene& scene() const override { return world_.scene(); }
    [[nodiscard]] RunSetup setup() const override { return world_.setup(); }
    [[nodiscard]] Frame step() override {
        world_.step();
        view_ = world_.view(width_, height_);
        return {index_++, stepSeconds, world_.state(), world_.dust(), view_, untimed_};
    }

 private:
    World world_;
    int width_, height_;
    std::int64_t index_ = 0;
    scene::View view_;
    StageClock untimed_;
};

}  // namespace

gpu::Device& ProgramContext::device() {
    if (!device_) device_.emplace();
    return *device_;
}

std::unique_ptr<ExperimentWorld> ProgramContext::world(const std::string& scene,
                                                       const std::map<std::string, std::string>& parameters, int width,
                                                       int height) {
    ParameterValues values(worldParameters());
    for (const auto& [name, text] : parameters) values.set(name, text);
    return std::make_unique<LentWorld>(scene, values, seed_, width, height);
}

}  // namespace dustbench::bench
