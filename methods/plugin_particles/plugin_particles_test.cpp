#include "methods/plugin_particles/plugin_particles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::plugin_particles {
namespace {

/// A fountain of one system; other systems differ in name.
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

PluginParticles made(const std::string& toml, const std::string& changes = "") {
    ParameterSet set;
    set.changes("at", "");
    ParameterValues values(set);
    values.set("at", changes);
    return PluginParticles(particles::systemsFromText(toml, "test.toml"), values.changes("at"));
}

class Counted final : public VolumeVisitor {
 public:
    void puffs(const Puffs& puffs) override {
        sizes.push_back(puffs.size());
        if (puffs.empty()) return;
        firstHeights.push_back(puffs.y[0]);
        for (std::size_t i = 0; i < puffs.size(); ++i) {
            const glm::vec3 place = puffs.position(i), colour = puffs.colour(i);
            finite = finite && std::isfinite(glm::dot(place, place) + glm::dot(colour, colour) + puffs.radius[i] +
                                             puffs.opacity[i]);
            farthest = std::max(farthest, glm::length(place));
        }
    }
    void octree(const OctreeVolume&) override {}
    void grid(const GridVolume&) override {}
    std::vector<std::size_t> sizes;
    std::vector<float> firstHeights;
    bool finite = true;
    float farthest = 0;
};

/// Sizes and heights of all particles.
class Seen final : public VolumeVisitor {
 public:
    void puffs(const Puffs& puffs) override {
        radius.insert(radius.end(), puffs.radius.begin(), puffs.radius.end());
        height.insert(height.end(), puffs.y.begin(), puffs.y.end());
    }
    void octree(const OctreeVolume&) override {}
    void grid(const GridVolume&) override {}
    std::vector<float> radius, height;
};

TEST(PluginParticles, StepsEverySystemAndTellsWhatEachHolds) {
    Moment moment;
    PluginParticles method = made(fountain("one") + fountain("two"));
    moment.run(method, 30);
    Counted counted;
    method.volume(moment.frame(), counted);
    EXPECT_THAT(counted.sizes, testing::ElementsAre(300, 300));
    EXPECT_NE(counted.firstHeights[0], counted.firstHeights[1]) << "the same chance for both";

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
    EXPECT_GE(bytes["two: primitives"], 300 * 20u);
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

TEST(PluginParticles, ASizeFactorScalesEverySizeAndNothingElse) {
    const TestFolder folder;
    const std::string random = "size = { part = \"random\", average_metres = 0.4, variation_metres = 0.3 }",
                      linear = "size = { part = \"linear\", start_metres = 0.1, end_metres = 0.7 }",
                      constant = "size = { part = \"constant\", radius_metres = 0.2 }";
    for (const std::string& size : {constant, random, linear}) {
        std::string toml = fountain("one");
        const auto file = folder.write("sized.toml", toml.replace(toml.find(constant), constant.size(), size));
        const auto particlesAt = [&](const char* factor) {
            const MethodInfo info = describe();
            ParameterValues values(info.parameters);
            values.set("system", file.string());
            values.set("size_factor", factor);
            const auto method = info.create(values);
            Moment moment;
            moment.run(*method, 30);
            Seen seen;
            method->volume(moment.frame(), seen);
            return seen;
        };
        const Seen one = particlesAt("1"), quarter = particlesAt("0.25");
        ASSERT_EQ(one.radius.size(), 300u);
        EXPECT_EQ(quarter.height, one.height);
        for (std::size_t i = 0; i < one.radius.size(); ++i)
            EXPECT_NEAR(quarter.radius[i], 0.25f * one.radius[i], 1e-6f) << size;
        EXPECT_THAT(inputError([&] { (void)particlesAt("1000000"); }), testing::HasSubstr("size_factor"));
    }
    std::string large = fountain("one");
    const auto file = folder.write("large.toml", large.replace(large.find("0.2 }\nlife"), 3, "500"));
    const MethodInfo info = describe();
    ParameterValues values(info.parameters);
    values.set("system", file.string());
    values.set("size_factor", "10");
    EXPECT_THAT(inputError([&] { (void)info.create(values); }),
                testing::AllOf(testing::HasSubstr("size_factor"), testing::HasSubstr("radius_metres"),
                               testing::HasSubstr("5000")));
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

std::optional<std::uint64_t> hashAfter(int steps, const std::string& changes, std::int64_t firstIndex = 0) {
    Moment moment;
    moment.index = firstIndex;
    PluginParticles method = made(fountain("one") + fountain("two"), changes);
    moment.run(method, steps);
    return method.stateHash();
}

TEST(PluginParticles, ChangeInTheFrameThatBeginsAtTheirTime) {
    const std::string change = "one.velocity.speed=9";
    for (const int frame : {0, 1, 7, 29}) {
        const std::string at = std::to_string(frame / 60.0) + "s:" + change;
        EXPECT_EQ(hashAfter(frame, at), hashAfter(frame, "")) << frame;
        EXPECT_NE(hashAfter(frame + 1, at), hashAfter(frame + 1, "")) << frame;
        EXPECT_EQ(hashAfter(frame + 10, at), hashAfter(frame + 10, at)) << frame;
    }
    // Changes do not apply during preroll and warm-up.
    EXPECT_EQ(hashAfter(10, "0s:" + change, -10), hashAfter(10, "", -10));
    EXPECT_NE(hashAfter(11, "0s:" + change, -10), hashAfter(11, "", -10));
}

TEST(PluginParticles, ChangesActInTheOrderOfTheirTimes) {
    EXPECT_EQ(hashAfter(30, "0.3s:one.velocity.speed=9;0.1s:two.size.part=linear"),
              hashAfter(30, "0.1s:two.size.part=linear;0.3s:one.velocity.speed=9"));
    EXPECT_EQ(hashAfter(30, "0.1s:one.velocity.speed=9;0.1s:one.velocity.speed=3"),
              hashAfter(30, "0.1s:one.velocity.speed=3"));
    EXPECT_NE(hashAfter(30, "0.1s:one.velocity.speed=9"), hashAfter(30, "0.1s:two.velocity.speed=9"));
}

TEST(PluginParticles, KeepTheirSystemsAsTheyAreAtTheEnd) {
    Moment moment;
    PluginParticles method = made(fountain("one") + fountain("two"), "0.1s:two.velocity.speed=9");
    moment.run(method, 3);
    const auto before = method.files();
    moment.step(method, 10);
    const auto after = method.files();
    ASSERT_EQ(after.size(), 1u);
    EXPECT_EQ(after[0].name, "systems.toml");
    EXPECT_THAT(after[0].text, testing::HasSubstr("speed = 9\n"));
    EXPECT_THAT(before[0].text, testing::Not(testing::HasSubstr("speed = 9\n")));

    // The state saved before the change, loaded and changed in the same way, has the same history.
    Moment again;
    PluginParticles loaded = made(before[0].text, "0.1s:two.velocity.speed=9");
    again.run(loaded, 13);
    EXPECT_EQ(loaded.stateHash(), method.stateHash());
    EXPECT_EQ(loaded.files()[0].text, after[0].text);
}

TEST(PluginParticles, RefuseImpossibleChangesAtOnce) {
    const std::string two = fountain("one") + fountain("two");
    EXPECT_THAT(
        inputError([&] { made(two, "1s:tow.velocity.speed=9"); }),
        testing::AllOf(testing::HasSubstr("change tow.velocity.speed=9: "), testing::HasSubstr("did you mean 'two'")));
    EXPECT_THAT(inputError([&] { made(two, "1s:one.velocity.sped=9"); }), testing::HasSubstr("did you mean 'speed'"));
    EXPECT_THAT(inputError([&] { made(fountain("one"), "1s:velocity.sped=9"); }),
                testing::HasSubstr("did you mean 'speed'"));
    // A parameter of a part that only an earlier change adds.
    EXPECT_THAT(inputError([&] { made(two, "1s:one.size.end_metres=2"); }), testing::HasSubstr("of 'constant'"));
    EXPECT_NO_THROW(made(two, "1s:one.size.end_metres=2;0.5s:one.size.part=linear"));
    for (const char* bad : {"-1s:one.velocity.speed=9", "1:one.velocity.speed=9", "1s", "1s:=2", "1s:a=", "nans:a=2"})
        EXPECT_THAT(inputError([&] { made(two, bad); }), testing::HasSubstr(std::string("parameter at: got '") + bad));
}

TEST(PluginParticles, GlowingSystemsLightTheSceneAndOthersDoNot) {
    Moment moment;
    PluginParticles dark = made(fountain("one"));
    moment.run(dark, 90);
    EXPECT_TRUE(dark.lights().empty());

    // k·Σ C·α·r³ over all particles, divided among the parts by age; no light outside the particles' extent.
    PluginParticles lit =
        made(fountain("one") + "shading = [ { part = \"glow\", lights = 4, strength = 50 } ]\n" + fountain("two"));
    Moment other;
    other.run(lit, 90);
    const auto lights = lit.lights();
    ASSERT_EQ(lights.size(), 4u);
    Counted counted;
    lit.volume(other.frame(), counted);
    glm::vec3 sum(0);
    for (const scene::PointLight& light : lights) {
        sum += light.intensity;
        EXPECT_LT(glm::distance(light.position, glm::dvec3(0, 0.5, -8)), 1.5);
    }
    // Opacity is at most 1/2 by default; the bound is the value for 600 particles of 0.2 m at opacity 1.
    EXPECT_GT(sum.b, 0);
    EXPECT_LT(sum.b, 50 * 0.9f * 0.008f * 700);
    EXPECT_NEAR(sum.r / sum.b, 0.2 / 0.9, 1e-3);
    EXPECT_NEAR(sum.g / sum.b, 0.4 / 0.9, 1e-3);
    // The same as without the part: glow does not change colours.
    EXPECT_EQ(counted.sizes.size(), 2u);
}

/// A minute of a delivered system: the particle count stays at the requested number, and all states are finite.
/// `fullSize`: at the system's own rate.
void expectStable(const std::string& name, bool fullSize) {
    Moment moment;
    moment.scene.vehicle.emplace();
    PluginParticles method(particles::systemsFromFile(files::findData("system", "particles", name, ".toml")));
    const bool ownRate = fullSize || name == "fireworks" || name == "steam";  // those have events
    method.prepare(moment.scene, {1, ownRate ? 0 : 2000}, Moment::device());
    double sum = 0;  // over the last 40 s, since bursts make the count oscillate
    for (int second = 0; second < 60; ++second) {
        for (scene::WheelState& wheel : moment.state.vehicle.wheels) wheel.velocity = {20, 0, 0};
        moment.state.vehicle.speed = 20;
        moment.step(method, 60);
        Counted counted;
        method.volume(moment.frame(), counted);
        std::size_t alive = 0;
        for (const std::size_t size : counted.sizes) alive += size;
        ASSERT_LE(alive, ownRate ? 200'000u : 4000u) << name << " after " << second << " s";
        ASSERT_TRUE(counted.finite) << name << " after " << second << " s";
        ASSERT_LT(counted.farthest, 2000) << name << " after " << second << " s";
        if (second >= 20) sum += static_cast<double>(alive);
    }
    if (ownRate) {
        EXPECT_GT(sum / 40, 100) << name;
        return;
    }
    EXPECT_GT(sum / 40, 1200) << name;
    EXPECT_LT(sum / 40, 2600) << name;
}

/// With DUSTBENCH_FULL_SIZE at the systems' own rates (`make long`), otherwise on one thread, because with so few
/// particles a second one would mostly wait.
TEST(PluginParticles, DeliveredSystemsAreStable) {
    const bool fullSize = std::getenv("DUSTBENCH_FULL_SIZE") != nullptr;
    tbb::task_arena arena(fullSize ? tbb::task_arena::automatic : 1);
    for (const std::string& name : files::listData("particles", ".toml"))
        arena.execute([&] { expectStable(name, fullSize); });
}

TEST(PluginParticles, DrawsTheSameTwice) {
    Moment moment;
    PluginParticles method = made(fountain("one") + fountain("two"));
    moment.run(method, 30);
    const pictures::Image first = moment.draw(method);
    EXPECT_EQ(first.pixels, moment.draw(method).pixels);
    EXPECT_GT(std::ranges::count_if(first.pixels, [](const glm::vec4& p) { return p.a > 0.1f; }), 100);
}

TEST(Marks, ShowEachPartWhereItIsAndOnlyIfItIsAsked) {
    // The particles are behind the camera.
    const auto shown = [](const std::string& drawn) {
        std::string toml = fountain("marked");
        toml.replace(toml.find("[0, 0, -8]"), 10, "[0, 0, 80]");
        toml.insert(
            toml.find("force = [") + 9,
            "{ part = \"bounce\", shape = \"disc\", place = [0, 1, -8], normal = [0, 0, 1], radius_metres = 0.5, "
            "drawn = " +
                drawn +
                " }, { part = \"bounce\", shape = \"sphere\", place = [2, 1, -8], radius_metres = 0.5, drawn = " +
                drawn + " }, { part = \"attractor\", place = [-2, 1, -8], drawn = " + drawn + " }, ");
        Moment moment;
        PluginParticles method = made(toml);
        moment.run(method, 2);
        return moment.picture([&](gpu::Layer& layer) { method.draw(moment.frame(), layer); });
    };
    const pictures::Image with = shown("true"), without = shown("false");
    const glm::mat4 toClip = Moment().view.worldToClip();
    const auto alphaAt = [&](const pictures::Image& image, const glm::vec3& place) {
        const glm::vec4 clip = toClip * glm::vec4(place, 1);
        const int x = static_cast<int>((clip.x / clip.w + 1) * 80), y = static_cast<int>((1 - clip.y / clip.w) * 60);
        return image.pixels[static_cast<std::size_t>(y * image.width + x)].a;
    };
    for (const float x : {0.0f, 2.0f, -2.0f}) {
        EXPECT_NEAR(alphaAt(with, {x, 1, -8}), 0.999, 1e-3) << x;
        EXPECT_EQ(alphaAt(without, {x, 1, -8}), 0) << x;
    }
    EXPECT_NEAR(alphaAt(with, {0.4f, 1, -8}), 0.999, 1e-3);
    for (const float x : {-1.0f, 0.7f, 1.3f}) EXPECT_EQ(alphaAt(with, {x, 1, -8}), 0) << x;
}

}  // namespace
}  // namespace dustbench::plugin_particles
