// Systems that are stepped and drawn on the GPU, compared with the same systems on the CPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/plugin_particles/plugin_particles.h"

namespace dustbench::plugin_particles {
namespace {

using Values = std::map<std::string, std::string>;

std::unique_ptr<Method> systemWith(const Values& parameters) {
    const MethodInfo info = describe();
    ParameterValues values(info.parameters);
    for (const auto& [name, value] : parameters) values.set(name, value);
    return info.create(values);
}

/// A delivered system; sprites without copies, which need the CPU.
std::unique_ptr<Method> fromFile(const char* name, SystemsOn processor) {
    std::string toml = files::wholeText(files::findData("particle system", "particles", name, ".toml"), "a TOML file");
    const std::string copies = "part = \"aa_sprites\"\ncopies = 4\nseconds = 0.03";
    if (const std::size_t at = toml.find(copies); at != std::string::npos)
        toml.replace(at, copies.size(), "part = \"sprites\"");
    return std::make_unique<PluginParticles>(particles::systemsFromText(toml, name), std::vector<Change>{}, Sight{},
                                             processor);
}

class World : public TestMoment {
 public:
    World() : TestMoment(0, 160, 120, {0, 2, 8}, {0, 0, -1}) { scene.vehicle.emplace(); }

    void run(Method& method, int steps, const RunSetup& setup = {}) {
        method.prepare(scene, setup, device());
        for (int i = 0; i < steps; ++i) {
            state.timeSeconds += 1.0 / 60;
            for (scene::WheelState& wheel : state.vehicle.wheels) wheel.velocity = {20, 0, 0};
            state.vehicle.speed = 20;
            method.update(frame());
        }
    }
};

class AllPuffs final : public VolumeVisitor {
 public:
    void puffs(const Puffs& puffs) override { count += puffs.size(); }
    void octree(const OctreeVolume&) override {}
    void grid(const GridVolume&) override {}
    std::size_t count = 0;
};

TEST(GpuSystems, HaveTheStateAndThePictureOfTheCpu) {
    for (const char* name : {"wheel_dust_mixed", "rocket"}) {
        World onCpu, onGpu;
        const auto cpu = fromFile(name, SystemsOn::cpu), gpu = fromFile(name, SystemsOn::gpu);
        onCpu.run(*cpu, 90);
        onGpu.run(*gpu, 90);
        EXPECT_EQ(gpu->primitives(), cpu->primitives()) << name;
        EXPECT_GT(cpu->primitives(), 100) << name;
        // GPUs may round quotients and roots differently.
        if (World::device().isSoftware()) {
            EXPECT_EQ(gpu->stateHash(), cpu->stateHash()) << name;
        }
        AllPuffs handedOver;
        gpu->volume(onGpu.frame(), handedOver);
        EXPECT_EQ(handedOver.count, static_cast<std::size_t>(gpu->primitives())) << name;

        const pictures::Image expected = onCpu.draw(*cpu), got = onGpu.draw(*gpu);
        float most = 0;
        for (std::size_t i = 0; i < got.pixels.size(); ++i)
            most = std::max(most, glm::distance(got.pixels[i], expected.pixels[i]));
        EXPECT_LT(most, 1e-3f) << name;
        EXPECT_GT(std::ranges::count_if(expected.pixels, [](const glm::vec4& p) { return p.r > 0.01f; }), 100) << name;
    }
}

TEST(GpuSystems, KeepTheRequestedNumberAsOnTheCpu) {
    std::vector<std::int64_t> counts;
    for (const char* processor : {"cpu", "gpu"}) {
        World world;
        const auto method = systemWith({{"system", "wheel_dust"}, {"systems_on", processor}});
        world.run(*method, 60, {1, 400});
        counts.push_back(method->primitives());
    }
    EXPECT_GT(counts[0], 50);
    EXPECT_EQ(counts[0], counts[1]);
}

TEST(GpuSystems, AreRefusedWithTheReason) {
    const auto refusal = [](const Values& values, bool sun = false) {
        Values moved = values;
        moved["systems_on"] = "gpu";
        World world;
        world.scene.lights.onDust = sun;
        return inputError([&] { systemWith(moved)->prepare(world.scene, {}, World::device()); });
    };
    EXPECT_EQ(refusal({{"system", "boids"}}).find("parameter systems_on: got gpu with the part "), 0u)
        << refusal({{"system", "boids"}});
    EXPECT_NE(refusal({{"system", "fountain"}}).find(", allowed: cpu"), std::string::npos);
    EXPECT_EQ(refusal({{"system", "wheel_dust"}, {"culling", "on"}}),
              "parameter systems_on: got gpu with culling or detail_pixels, allowed: cpu");
    EXPECT_EQ(refusal({{"system", "wheel_dust"}, {"storage", "pool"}}),
              "parameter systems_on: got gpu with the storage of the system 'wheel_dust', allowed: cpu");
    EXPECT_EQ(refusal({{"system", "wheel_dust"}}, true), "parameter systems_on: got gpu with light=sun, allowed: cpu");
    EXPECT_EQ(refusal({{"system", "wheel_dust"}, {"at", "1s:size.end_metres=2"}}),
              "parameter systems_on: got gpu with changes during the run, allowed: cpu");
}

}  // namespace
}  // namespace dustbench::plugin_particles
