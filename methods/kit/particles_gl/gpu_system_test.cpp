#include "methods/kit/particles_gl/gpu_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/gpu/faulty_driver.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

using particles::test::drivingStraight;
using particles::test::everyForce;
using particles::test::sceneWithCar;
using particles::test::with;

gpu::Device& dustDevice() {
    static gpu::Device device;
    return device;
}

/// One system on the CPU and one on the GPU, from the same text.
struct Pair {
    explicit Pair(const std::string& toml, std::uint64_t seed = 1)
        : cpu(particles::test::systemFrom(toml, seed)),
          parts(partsFromText(toml, "test.toml")),
          gpu(dustDevice(), *parts, seed) {}

    void advance(const scene::Scene& scene, int steps, double speed = 20, std::int64_t fixedCount = 0) {
        for (int i = 0; i < steps; ++i) {
            const scene::SceneState state = drivingStraight(++stepped / 60.0, speed);
            const Surroundings around{scene, state, 1.0 / 60, fixedCount};
            cpu.update(around);
            gpu.update(around);
        }
    }

    ParticleSystem cpu;
    std::unique_ptr<PartList> parts;
    GpuSystem gpu;
    int stepped = 0;
};

double largestDistance(const ParticleStore& a, const ParticleStore& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, static_cast<double>(glm::length(a.position(i) - b.position(i))));
    return largest;
}

/// Serials in storage order, births and deaths exactly; the rest within rounding.
void expectEqual(Pair& pair, const std::string& when) {
    const ParticleStore& cpu = pair.cpu.store();
    const ParticleStore& gpu = pair.gpu.readBack();
    ASSERT_EQ(gpu.size(), cpu.size()) << when;
    ASSERT_TRUE(std::ranges::equal(gpu.serial, cpu.serial)) << when;
    EXPECT_TRUE(std::ranges::equal(gpu.age, cpu.age)) << when;
    EXPECT_TRUE(std::ranges::equal(gpu.lifetime, cpu.lifetime)) << when;
    EXPECT_LT(largestDistance(gpu, cpu), 1e-4) << when;
    for (std::size_t i = 0; i < cpu.size(); ++i) {
        ASSERT_NEAR(gpu.opacity[i], cpu.opacity[i], 1e-6) << when;
        ASSERT_NEAR(gpu.radius[i], cpu.radius[i], 1e-6f * cpu.radius[i]) << when;
        ASSERT_EQ(gpu.colour(i), cpu.colour(i)) << when;
    }
    ASSERT_LE(gpu.size(), pair.gpu.buffers().bound) << when;
}

scene::Scene hillyScene() {
    scene::Scene scene = sceneWithCar();
    std::vector<float> heights;
    for (int row = 0; row < 12; ++row)
        for (int column = 0; column < 40; ++column)
            heights.push_back(0.4f * std::sin(0.9f * static_cast<float>(column)) * std::cos(static_cast<float>(row)));
    scene.terrain = scene::Terrain(heights, 40, 12, 3.0f, -10.0f, -15.0f);
    return scene;
}

TEST(GpuSystem, HasTheParticlesOfTheCpuInTheirOrder) {
    for (const std::uint64_t seed : {1ull, 0x123456789abcdefull}) {
        Pair pair(everyForce, seed);
        for (int tenth = 0; tenth < 12; ++tenth) {
            pair.advance(sceneWithCar(), 10);
            expectEqual(pair, "seed " + std::to_string(seed) + ", step " + std::to_string(pair.stepped));
        }
        EXPECT_GT(pair.cpu.store().size(), 300u);
    }
}

TEST(GpuSystem, IsTheSameForEachPartWithAShader) {
    const std::string cone = R"(part = "cone", direction = [-0.5, 0.8, 0.1], half_angle_degrees = 50, speed = 0.5, )"
                             R"(speed_share = 0.15, variation = 0.6, inherit = 0.2)";
    const std::vector<std::pair<std::string, std::string>> changes{
        {R"(position = { part = "disc", radius_metres = 0.2 })", R"(position = { part = "point" })"},
        {R"(radius_metres = 0.2 })", R"(radius_metres = 0.2, normal = [0.3, 0.2, -1.0] })"},
        {R"(radius_metres = 0.2 })", R"(radius_metres = 0.2, at = "place", place = [3.0, 1.5, -2.0] })"},
        {R"(part = "disc", radius_metres = 0.2)", R"(part = "rectangle", length_metres = 2, width_metres = 0.4)"},
        {R"(part = "disc", radius_metres = 0.2)",
         R"(part = "rectangle", length_metres = 2, width_metres = 0.4, normal = [0.3, 0.2, -1.0])"},
        {R"(part = "disc", radius_metres = 0.2)",
         R"(part = "line", length_metres = 2, direction = [0.2, 0.5, 1], base = "middle")"},
        {R"(part = "disc", radius_metres = 0.2)", R"(part = "line", length_metres = 0.7, base = "end")"},
        {R"(part = "disc", radius_metres = 0.2)", R"(part = "sphere", radius_metres = 0.6)"},
        {cone, R"(part = "random", speed = 2, variation = 1)"},
        {cone, R"(part = "fixed", direction = [0.4, 1, -0.2], speed = 2, variation = 0.5)"},
        {R"(size = { part = "linear" })",
         R"(size = { part = "random", average_metres = 0.3, variation_metres = 0.2 })"},
        {R"(part = "cone")", R"(part = "cone", mode = "paper")"},
        {R"(part = "constant", colour = [0.6, 0.5, 0.4], opacity_curve = "bezier")",
         R"(part = "constant", opacity_curve = "linear")"},
        {R"(part = "constant", colour = [0.6, 0.5, 0.4])",
         R"(part = "bands", first = [0.6, 0.5, 0.3], second = [0.2, 0.1, 0.0], births = 7)"},
        {R"(part = "constant", colour = [0.6, 0.5, 0.4], opacity_curve = "bezier")",
         R"(part = "linear", start = [0.9, 0.5, 0.2], end = [0.1, 0.0, 0.3], opacity_curve = "bezier")"},
        {R"(part = "constant", colour = [0.6, 0.5, 0.4])",
         R"(part = "bezier", start = [0.9, 0.5, 0.2], early = [0.2, 0.8, 0.0], late = [0.0, 0.9, 0.1], end = [0.3, 0.0, 0.6])"},
        {R"(size = { part = "linear" })", R"(size = { part = "constant" })"},
        {R"({ part = "wind", factor = 0.8, gust_speed = 0.7, gust_metres = 3 })",
         R"({ part = "wind" }, { part = "constant", force = [0.3, 0.1, -0.2], mass_kilograms = 2 })"},
    };
    for (const auto& [from, to] : changes) {
        Pair pair(with(everyForce, from, to));
        pair.advance(sceneWithCar(), 90);
        expectEqual(pair, to);
    }
}

TEST(GpuSystem, TouchesAHillyGroundAsTheCpuDoes) {
    Pair pair(everyForce);
    pair.advance(hillyScene(), 120);
    expectEqual(pair, "hills");
}

/// More die than are born, then none live, then many are born again: every way of filling gaps.
TEST(GpuSystem, KeepsItsOrderWhenTheCloudShrinksAndGrows) {
    Pair pair(with(everyForce, "rate_per_second = 30", "rate_per_second = 0"));
    for (const auto& [steps, speed] : std::vector<std::pair<int, double>>{
             {40, 30.0}, {20, 5.0}, {10, 0.0}, {60, 1.0}, {120, 0.0}, {30, 40.0}, {50, 2.0}})
        for (int i = 0; i < steps; ++i) {
            pair.advance(sceneWithCar(), 1, speed);
            if (i % 5 == 0) expectEqual(pair, "step " + std::to_string(pair.stepped));
        }
    expectEqual(pair, "at the end");
}

TEST(GpuSystem, GrowsItsBuffersWithoutLosingParticles) {
    for (const std::int64_t count : {1ll, 100ll, 20'000ll}) {
        Pair pair(everyForce);
        pair.advance(sceneWithCar(), 60, 20, count);
        pair.advance(sceneWithCar(), 40, 20, 3 * count);
        expectEqual(pair, std::to_string(count) + " particles");
    }
}

/// llvmpipe divides and takes roots exactly, so that not only the order is equal.
TEST(GpuSystem, IsEqualToTheBitOnASoftwareDevice) {
    if (!dustDevice().isSoftware()) GTEST_SKIP() << "a GPU may round quotients and roots differently";
    Pair pair(everyForce);
    pair.advance(hillyScene(), 200);
    EXPECT_EQ(pair.gpu.readBack().hash(), pair.cpu.stateHash());
}

/// Each pass sees what the passes before it have written, on every device.
TEST(GpuSystem, EndsEveryPassWithABarrier) {
    Pair pair(everyForce);
    pair.advance(sceneWithCar(), 5);
    const gpu::WatchedBarriers watched;
    pair.advance(sceneWithCar(), 5);
    EXPECT_GT(watched.dispatches(), 5 * 10);
    EXPECT_EQ(watched.missing(), 0);
}

TEST(GpuSystem, StepsWithoutAReadBack) {
    Pair pair(everyForce);
    const gpu::CountedReadBacks readBacks;
    pair.advance(sceneWithCar(), 100);
    EXPECT_EQ(readBacks.count(), 0);
    expectEqual(pair, "afterwards");
    EXPECT_GT(readBacks.count(), 0);
}

TEST(GpuSystem, NamesThePartWithoutAShader) {
    const std::string toml = with(everyForce, R"({ part = "gravity", acceleration = 1.5 })", R"({ part = "bounce" })");
    try {
        Pair pair(toml);
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "particles on the GPU: the part force 'bounce' has no shader");
    }
}

}  // namespace
}  // namespace dustbench::particles
