// Tests changes of a system's parts, by name and of the parts themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "methods/kit/particles/part.h"
#include "methods/kit/particles/part_list.h"
#include "methods/kit/particles/test_world.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::particles {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::unique_ptr<PartList> parts() {
    return partsFromText(test::everyForce, "test.toml");
}

/// Returns everyForce as a file after these changes.
std::string after(std::initializer_list<std::pair<const char*, const char*>> changes) {
    const auto list = parts();
    for (const auto& [name, value] : changes) changePart(*list, name, value);
    return partsToToml(*list);
}
std::string written(const std::string& from, const std::string& to) {
    return partsToToml(*partsFromText(test::with(test::everyForce, from, to), "test.toml"));
}

TEST(PartChange, GivesWhatTheFileWithTheChangeGives) {
    EXPECT_EQ(after({{"velocity.speed", "8"}}), written("speed = 0.5", "speed = 8"));
    EXPECT_EQ(after({{"velocity.direction.y", "-1"}}), written("0.8, 0.1", "-1, 0.1"));
    EXPECT_EQ(after({{"size.part", "constant"}, {"size.radius_metres", "2"}}),
              written(R"(part = "linear" })", R"(part = "constant", radius_metres = 2 })"));
    EXPECT_EQ(after({{"force.gravity.acceleration", "3"}}), written("acceleration = 1.5", "acceleration = 3"));
    EXPECT_EQ(after({{"force.1.acceleration", "3"}}), written("acceleration = 1.5", "acceleration = 3"));
    EXPECT_EQ(after({{"force.drag.part", "none"}}), written(R"({ part = "drag", rate_per_second = 2.5 },)", ""));
    EXPECT_EQ(after({{"force.drag.part", "gravity"}}),
              written(R"({ part = "drag", rate_per_second = 2.5 })", R"({ part = "gravity" })"));
    EXPECT_EQ(after({{"force.part", "gravity"}}),
              written("friction_per_second = 3 },", R"(friction_per_second = 3 }, { part = "gravity" },)"));
    EXPECT_EQ(after({{"render.part", "puff"}}),
              partsToToml(*partsFromText(test::everyForce + "render = { part = \"puff\" }", "test.toml")));
}

TEST(PartChange, ErrorsNameTheNearestNameAndChangeNothing) {
    const auto errorOf = [](const char* name, const char* value) {
        const auto list = parts();
        std::string message = inputError([&] { changePart(*list, name, value); });
        EXPECT_EQ(partsToToml(*list), partsToToml(*parts())) << name;
        return message;
    };
    EXPECT_THAT(errorOf("velocty.speed", "8"), HasSubstr("did you mean 'velocity'"));
    EXPECT_THAT(errorOf("velocity.sped", "8"), HasSubstr("did you mean 'speed'"));
    EXPECT_THAT(errorOf("velocity", "8"), HasSubstr("parameter of 'cone'"));
    EXPECT_THAT(errorOf("velocity.speed", "fast"), AllOf(HasSubstr("got 'fast'"), HasSubstr("number 0..1000")));
    EXPECT_THAT(errorOf("velocity.part", "con"), HasSubstr("did you mean 'cone'"));
    EXPECT_THAT(errorOf("force.gravty.acceleration", "8"), HasSubstr("did you mean 'gravity'"));
    EXPECT_THAT(errorOf("force.9.acceleration", "8"), HasSubstr("known: gravity, drag, wind, ground"));
    EXPECT_THAT(errorOf("force.part", "gravty"), HasSubstr("did you mean 'gravity'"));
    EXPECT_THAT(errorOf("life.lifetime.part", "none"), HasSubstr("got 0, expected 1"));
    EXPECT_THAT(errorOf("life.part", "lifetime"), HasSubstr("got 2, expected 1"));
    EXPECT_THAT(errorOf("life.lifetime.variation_seconds", "0.9"), HasSubstr("less than average_seconds"));
    EXPECT_THAT(errorOf("render.pixels", "3"), HasSubstr("expected render.part=NAME first"));
}

TEST(PartChange, SavedLoadedAndPutBackInMidRunLeavesTheStateAlone) {
    for (const int steps : {1, 17, 60}) {
        const auto scene = test::sceneWithCar();
        auto system = test::systemFrom(test::everyForce), undisturbed = test::systemFrom(test::everyForce);
        test::advance(undisturbed, scene, steps + 60);
        test::advance(system, scene, steps);
        system.replaceParts(partsFromText(system.toToml(), "saved.toml"));
        test::advance(system, scene, 60, 20, 0, 1.0 / 60, steps);
        EXPECT_EQ(system.stateHash(), undisturbed.stateHash()) << steps;
    }
}

TEST(PartChange, AChangeToTheSameValueLeavesTheStateAloneAndAnotherDoesNot) {
    const auto hashAfter = [](const char* name, const char* value) {
        const auto scene = test::sceneWithCar();
        auto system = test::systemFrom(test::everyForce);
        test::advance(system, scene, 20);
        changePart(system.parts(), name, value);
        test::advance(system, scene, 30, 20, 0, 1.0 / 60, 20);
        return system.stateHash();
    };
    EXPECT_EQ(hashAfter("emission.rate_per_second", "30"), hashAfter("velocity.speed", "0.5"));
    EXPECT_NE(hashAfter("emission.rate_per_second", "31"), hashAfter("velocity.speed", "0.5"));
    EXPECT_NE(hashAfter("velocity.speed", "0.6"), hashAfter("velocity.speed", "0.5"));
    EXPECT_NE(hashAfter("force.wind.part", "none"), hashAfter("velocity.speed", "0.5"));
}

/// Replaces each part of the table by every other of its kind, while particles live.
TEST(PartChange, SwapsAnyPartForAnyOtherOfItsKind) {
    const auto scene = test::sceneWithCar();
    for (const PartInfo& from : partTable())
        for (const PartInfo& to : partTable()) {
            if (to.kind != from.kind) continue;
            auto system = test::systemFrom(test::everyForce);
            const std::string kind(kindName(from.kind));
            const std::string place = from.kind == PartKind::life ? "life.1.part" : kind + ".part";
            const bool givesLifetimes = from.name == "lifetime" && to.name == "lifetime";
            if (from.kind == PartKind::life && !givesLifetimes) continue;
            for (const PartInfo& info : {from, to}) test::giveLattice(system.parts(), info);
            changePart(system.parts(), place, from.name);
            test::advance(system, scene, 20, 20, 2000);
            const std::size_t before = system.store().size();
            changePart(system.parts(),
                       isList(from.kind) && from.kind != PartKind::life ? kind + "." + from.name + ".part" : place,
                       to.name);
            test::advance(system, scene, 20, 20, 2000, 1.0 / 60, 20);
            if (from.name != "on_event" || to.name != "on_event") {
                EXPECT_GT(before + system.store().size(), 0u) << from.name << " " << to.name;
            }
            const Puffs puffs = system.store();
            for (std::size_t i = 0; i < puffs.size(); ++i) {
                const glm::vec3 shown = puffs.position(i) + puffs.colour(i);
                ASSERT_TRUE(std::isfinite(shown.x + shown.y + shown.z + puffs.radius[i] + puffs.opacity[i]))
                    << kind << ": " << from.name << " then " << to.name;
            }
        }
}

// --- Each part replaced by every other of its kind while 10,000 particles live.

constexpr int count = 10'000;

/// Replaces the last part of a kind by the named one, or adds it to an empty list. Lifetimes are kept.
void put(PartList& parts, PartKind kind, const std::string& name) {
    if (kind == PartKind::force) parts.forces().clear();
    if (kind == PartKind::shading) parts.shadings().clear();
    if (kind == PartKind::event) parts.events().clear();
    if (kind == PartKind::life) {
        parts.lives().clear();
        if (name != "lifetime")
            parts.set(makePart(PartKind::life, "lifetime", {{"average_seconds", "0.8"}, {"variation_seconds", "0.2"}}));
    }
    NamedValues values;
    // The exact sum over 10,000 particles is slow, and this test only swaps.
    if (name == "interaction") values.emplace_back("opening_angle", "1.5");
    test::giveLattice(parts, findPart(kind, name));
    parts.set(makePart(kind, name, values));
}

bool isFinite(const ParticleStore& store) {
    for (const auto* column :
         {&store.x, &store.y, &store.z, &store.velocityX, &store.velocityY, &store.velocityZ, &store.age,
          &store.lifetime, &store.radius, &store.opacity, &store.red, &store.green, &store.blue})
        if (!std::ranges::all_of(*column, [](float v) { return std::isfinite(v); })) return false;
    return true;
}

/// Returns the hash after 10,000 particles were made: two steps with `first`, two with `second`, two with `first`
/// again.
std::uint64_t swapped(ParticleSystem& system, PartKind kind, const std::string& first, const std::string& second,
                      int from) {
    static const auto scene = test::sceneWithCar();
    int at = from;
    for (const std::string& name : {first, second, first}) {
        put(system.parts(), kind, name);
        test::advance(system, scene, 2, 20, count, 1.0 / 60, at);
        at += 2;
        EXPECT_TRUE(isFinite(system.store())) << kindName(kind) << ": " << first << ", " << second;
    }
    EXPECT_TRUE(system.parts().missing().empty());
    return system.stateHash();
}

ParticleSystem populated() {
    auto system = test::systemFrom(test::everyForce);
    test::advance(system, test::sceneWithCar(), 70, 20, count);
    return system;
}

class PartSwap : public testing::TestWithParam<PartKind> {};

TEST_P(PartSwap, OfAnyTwoOfAKindKeepsTheStateFiniteAndItsHistoryRepeats) {
    std::vector<std::string> names;
    for (const PartInfo& info : partTable())
        if (info.kind == GetParam()) names.push_back(info.name);
    ASSERT_FALSE(names.empty());
    auto one = populated(), other = populated();
    ASSERT_GT(one.store().size(), 9000u);
    int at = 70;
    for (const std::string& first : names)
        for (const std::string& second : names) {
            EXPECT_EQ(swapped(one, GetParam(), first, second, at), swapped(other, GetParam(), first, second, at))
                << first << ", " << second;
            at += 6;
        }
    EXPECT_GT(one.store().size(), 1000u);
}

INSTANTIATE_TEST_SUITE_P(EveryKind, PartSwap,
                         testing::Values(PartKind::emission, PartKind::position, PartKind::velocity, PartKind::colour,
                                         PartKind::size, PartKind::render, PartKind::life, PartKind::shading,
                                         PartKind::force, PartKind::event),
                         [](const auto& kind) { return std::string(kindName(kind.param)); });

}  // namespace
}  // namespace dustbench::particles
