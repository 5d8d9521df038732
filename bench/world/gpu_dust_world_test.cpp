#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "bench/world/data_list.h"
#include "bench/world/world.h"
#include "methods/contract/errors.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::world {
namespace {

gpu::Device& deviceOfDust() {
    static gpu::Device device;
    return device;
}

ParameterValues worldValues(const std::vector<std::pair<std::string, std::string>>& given) {
    ParameterValues values(worldParameters());
    for (const auto& [name, value] : given) values.set(name, value);
    return values;
}

/// The same world twice, with its dust on the CPU and on the GPU.
struct Worlds {
    Worlds(const std::string& scene, const std::string& drive,
           const std::vector<std::pair<std::string, std::string>>& values = {}, std::uint64_t seed = 1)
        : cpu(scene, drive, worldValues(values), seed), gpu(scene, drive, worldValues(values), seed) {
        gpu.moveDustTo(deviceOfDust());
    }
    void step(int steps) {
        for (int i = 0; i < steps; ++i) cpu.step(), gpu.step();
    }

    World cpu, gpu;
};

void expectSameDust(const Worlds& worlds, const std::string& where) {
    const Puffs cpu = worlds.cpu.dust(), gpu = worlds.gpu.dust();
    ASSERT_TRUE(std::ranges::equal(gpu.serial, cpu.serial)) << where;
    float largest = 0;
    for (std::size_t i = 0; i < cpu.size(); ++i)
        largest = std::max(largest, glm::length(gpu.position(i) - cpu.position(i)));
    EXPECT_LE(largest, 1e-4f) << where;
    EXPECT_EQ(gpu.uniformColour, cpu.uniformColour) << where;
    EXPECT_EQ(gpu.colourOfAll, cpu.colourOfAll) << where;
    if (deviceOfDust().isSoftware()) {
        EXPECT_EQ(worlds.gpu.stateHash(), worlds.cpu.stateHash()) << where;
    }
}

TEST(GpuDustWorld, HasTheDustOfTheCpuAfterTenSecondsOfEveryDrive) {
    for (const auto& [drive, description, panels] : listDrives()) {
        Worlds worlds("plain", drive);
        for (int second = 0; second < 10; second += 2) {
            worlds.step(120);
            expectSameDust(worlds, drive + " after " + std::to_string(second + 2) + " s");
        }
    }
}

TEST(GpuDustWorld, HasTheDustOfTheCpuInEverySceneWithItsParts) {
    for (const char* scene : {"carr_plain", "dunes", "two_soils", "void"})
        for (const std::uint64_t seed : {1, 77}) {
            Worlds worlds(scene, "", {}, seed);
            worlds.step(150);
            expectSameDust(worlds, scene);
        }
}

TEST(GpuDustWorld, KeepsAFixedNumberOfParticles) {
    Worlds worlds("plain", "straight", {{"particles", "30000"}});
    worlds.step(300);
    EXPECT_NEAR(static_cast<double>(worlds.gpu.dust().size()), 30'000, 300);
    expectSameDust(worlds, "30,000 particles");
}

TEST(GpuDustWorld, IsRefusedWithTheNameOfWhatHasNoShader) {
    const auto refusal = [](World&& world) -> std::string {
        try {
            world.moveDustTo(deviceOfDust());
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal(World("smoke", "", worldValues({}), 1)),
              "dust_on: got gpu, but the part colour 'bezier_points' has no shader, allowed: cpu");
    EXPECT_EQ(refusal(World("plain", "", worldValues({{"light", "sun"}}), 1)),
              "dust_on: got gpu, but light=sun has no shader, allowed: cpu");
}

}  // namespace
}  // namespace dustbench::world
