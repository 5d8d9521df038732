// Replaces each part by every other of its kind while 10,000 particles live.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "methods/kit/particles/part_table.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

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
