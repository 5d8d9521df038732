// The method of particle systems with `wheel_dust` equals the shared dust: the same state, drawn like billboards.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "bench/results/run_spec.h"
#include "bench/world/world.h"
#include "methods/contract/registry.h"
#include "methods/kit/draw/test_canvas.h"
#include "source_folder.h"

namespace dustbench {
namespace {

struct Cell {
    std::string scene, particles;
    std::uint64_t seed;
};

/// A world and a method in it, stepped together.
class Running {
 public:
    Running(const std::string& method, const Cell& cell, const results::ParameterTexts& given)
        : parameters_(results::resolveParameters(findMethod(method), with(given, cell.particles))),
          world_(cell.scene, "", parameters_.world, cell.seed),
          canvas_(160, 120, {0, 0, 0}, {1, 0, 0}),
          method_(findMethod(method).create(parameters_.method)) {
        method_->prepare(world_.scene(), world_.setup(), draw::TestCanvas::device());
    }

    void step(int steps) {
        for (int i = 0; i < steps; ++i) {
            world_.step();
            canvas_.view.camera = world_.view(160, 120).camera;
            method_->update(frame(i));
        }
    }
    pictures::Image picture() {
        return canvas_.picture([&](gpu::Layer& layer) { method_->draw(frame(0), layer); });
    }
    [[nodiscard]] const world::World& world() const { return world_; }
    [[nodiscard]] const Method& method() const { return *method_; }

 private:
    static results::ParameterTexts with(results::ParameterTexts given, const std::string& particles) {
        given["particles"] = particles;
        return given;
    }
    [[nodiscard]] Frame frame(std::int64_t index) const {
        return {index, world::stepSeconds, world_.state(), world_.dust(), canvas_.view, untimed_};
    }

    results::ResolvedParameters parameters_;
    world::World world_;
    StageClock untimed_;
    draw::TestCanvas canvas_;
    std::unique_ptr<Method> method_;
};

const std::vector<Cell> cells{{"plain", "0", 1}, {"plain", "700", 2}, {"dunes", "0", 3}, {"wall", "300", 4}};

TEST(WheelDust, HasTheStateOfTheSharedDust) {
    for (const Cell& cell : cells) {
        Running run("plugin_particles", cell, {});
        for (int part = 0; part < 3; ++part) {
            run.step(40);
            EXPECT_GT(run.world().dust().size(), 20u);
            EXPECT_EQ(run.method().stateHash(), run.world().stateHash()) << cell.scene << " " << cell.particles;
        }
    }
}

TEST(WheelDust, HasAStateOfItsOwnWhereTheSystemDiffers) {
    const Cell& cell = cells.front();
    Running run("plugin_particles", cell, {{"system", DUSTBENCH_SOURCE_DIR "/tests/wheel_dust/slow_dust.toml"}});
    run.step(60);
    EXPECT_GT(run.method().primitives(), 50);
    EXPECT_NE(run.method().stateHash(), run.world().stateHash());
}

TEST(WheelDust, LooksAsBillboardsDo) {
    for (const Cell& cell : cells) {
        Running own("plugin_particles", cell, {}), billboards("billboard", cell, {});
        own.step(60);
        billboards.step(60);
        EXPECT_EQ(own.picture().pixels, billboards.picture().pixels) << cell.scene << " " << cell.particles;
        EXPECT_EQ(own.method().primitives(), billboards.method().primitives());
    }
}

}  // namespace
}  // namespace dustbench
