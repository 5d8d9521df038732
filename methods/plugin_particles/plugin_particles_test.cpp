#include "methods/plugin_particles/plugin_particles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::plugin_particles {
namespace {

/// A fountain of one system; others get another name.
std::string fountain(const std::string& name) {
    return "[[system]]\nname = \"" + name + R"("
emission = { part = "stream", rate_per_second = 600, rate_per_metre = 0 }
position = { part = "point", at = "place", place = [0, 0, -8] }
velocity = { part = "cone", direction = [0, 1, 0], half_angle_degrees = 20, speed = 4, speed_share = 0, inherit = 0 }
colour = { part = "constant", colour = [0.2, 0.4, 0.9], from = "own" }
size = { part = "constant", radius_metres = 0.2 }
life = [ { part = "lifetime", average_seconds = 1, variation_seconds = 0.2 } ]
force = [ { part = "gravity", acceleration = 9.8 } ]
)";
}

class Moment : public TestMoment {
 public:
    Moment() : TestMoment(0, 160, 120, {0, 1, 0}, {0, 0, -1}) {}

    void run(Method& method, int steps, RunSetup setup = {}) {
        method.prepare(scene, setup, device());
        step(method, steps);
    }
    void step(Method& method, int steps) {
        for (int i = 0; i < steps; ++i) {
            state.timeSeconds += 1.0 / 60;
            Frame now = frame();
            now.index = index++;
            method.update(now);
        }
    }
    std::int64_t index = 0;
};

PluginParticles made(const std::string& toml) {
    return PluginParticles(particles::systemsFromText(toml, "test.toml"));
}

class Counted final : public VolumeVisitor {
 public:
    void puffs(const Puffs& puffs) override { sizes.push_back(puffs.size()); }
    void octree(const OctreeVolume&) override {}
    void grid(const GridVolume&) override {}
    std::vector<std::size_t> sizes;
};

TEST(PluginParticles, StepsEverySystemAndTellsWhatEachHolds) {
    Moment moment;
    PluginParticles method = made(fountain("one") + fountain("two"));
    moment.run(method, 30);
    Counted counted;
    method.volume(moment.frame(), counted);
    EXPECT_THAT(counted.sizes, testing::ElementsAre(300, 300));

    const MethodInfo info = describe();
    Facts atEnd(info.facts, FactOver::lastFrame), maxima(info.facts, FactOver::maximumOfFrames);
    method.report(moment.frame(), atEnd);
    method.report(moment.frame(), maxima);
    EXPECT_EQ(atEnd.value("alive_1"), FactValue(std::int64_t{300}));
    EXPECT_EQ(atEnd.value("alive_2"), FactValue(std::int64_t{300}));
    EXPECT_EQ(atEnd.value("alive_3"), std::nullopt);
    EXPECT_EQ(atEnd.value("systems"), FactValue(std::int64_t{2}));
    EXPECT_EQ(maxima.value("alive_max"), FactValue(std::int64_t{600}));
    EXPECT_EQ(method.primitives(), 600);

    std::map<std::string, std::size_t> bytes;
    for (const MemoryUse& use : method.memory()) bytes[use.structure] += use.cpuBytes + use.gpuBytes;
    EXPECT_GE(bytes["one: particle positions"], 300 * 12u);
    EXPECT_GE(bytes["two: particle positions"], 300 * 12u);
    EXPECT_GE(bytes["two: billboards"], 300 * 20u);
}

TEST(PluginParticles, SystemsDifferByTheirSeedAloneAndByTheRuns) {
    Moment moment;
    const auto hashOf = [](const std::string& toml, std::uint64_t seed) {
        Moment own;
        PluginParticles method = made(toml);
        own.run(method, 20, {seed, 0});
        return method.stateHash();
    };
    EXPECT_EQ(hashOf(fountain("one"), 3), hashOf(fountain("other"), 3));
    EXPECT_NE(hashOf(fountain("one"), 3), hashOf(fountain("one"), 4));
    EXPECT_NE(hashOf(fountain("one"), 3), hashOf(fountain("one") + fountain("two"), 3));
}

TEST(PluginParticles, ShareTheLoadEvenly) {
    Moment moment;
    PluginParticles method = made(fountain("a") + fountain("b") + fountain("c"));
    moment.run(method, 180, {1, 902});
    Counted counted;
    method.volume(moment.frame(), counted);
    ASSERT_EQ(counted.sizes.size(), 3u);
    for (const std::size_t size : counted.sizes) EXPECT_NEAR(static_cast<double>(size), 301, 6);

    PluginParticles tooMany = made(fountain("a") + fountain("b"));
    EXPECT_EQ(inputError([&] {
                  moment.run(tooMany, 1, {1, 1});
              }),
              "parameter particles: got 1, allowed: 0, or at least 2, one for each system");
}

TEST(PluginParticles, DrawsTheSameTwice) {
    Moment moment;
    PluginParticles method = made(fountain("one") + fountain("two"));
    moment.run(method, 30);
    const pictures::Image first = moment.draw(method);
    EXPECT_EQ(first.pixels, moment.draw(method).pixels);
    EXPECT_GT(std::ranges::count_if(first.pixels, [](const glm::vec4& p) { return p.a > 0.1f; }), 100);
}

}  // namespace
}  // namespace dustbench::plugin_particles
