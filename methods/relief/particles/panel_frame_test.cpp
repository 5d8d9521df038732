#include "methods/relief/particles/panel_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace dustbench::relief {
namespace {

glm::dmat4 randomPose(std::mt19937& random) {
    std::normal_distribution<double> gauss;
    const glm::dvec3 axis = glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
    const glm::dvec3 place = 30.0 * glm::dvec3(gauss(random), gauss(random), gauss(random));
    return glm::rotate(glm::translate(glm::dmat4(1), place), 3 * gauss(random), axis);
}

glm::dvec3 randomVector(std::mt19937& random) {
    std::normal_distribution<double> gauss;
    return {gauss(random), gauss(random), gauss(random)};
}

TEST(PanelFrame, ThereAndBackIsTheIdentityAlsoWhenThePanelMovesAndTurns) {
    std::mt19937 random(4);
    for (int n = 0; n < 1000; ++n) {
        const glm::dmat4 after = randomPose(random);
        const glm::dmat4 before = glm::rotate(after, 0.2, glm::normalize(randomVector(random)));
        const PanelFrame frame(before, after, 1.0 / 60);
        const Moving world{10.0 * randomVector(random), 5.0 * randomVector(random)};
        const Moving back = frame.toWorld(frame.toPanel(world));
        ASSERT_LT(glm::distance(back.place, world.place), 1e-11);
        ASSERT_LT(glm::distance(back.velocity, world.velocity), 1e-10);
    }
}

TEST(PanelFrame, KeepsTheEnergyWhenThePanelRests) {
    std::mt19937 random(5);
    for (int n = 0; n < 100; ++n) {
        const glm::dmat4 pose = randomPose(random);
        const PanelFrame frame(pose, pose, 0.1);
        const Moving world{randomVector(random), 7.0 * randomVector(random)};
        ASSERT_NEAR(glm::length(frame.toPanel(world).velocity), glm::length(world.velocity), 1e-12);
    }
}

TEST(PanelFrame, AParticleThatMovesWithThePanelRestsInItsFrame) {
    std::mt19937 random(6);
    const double seconds = 1.0 / 60;
    for (int n = 0; n < 100; ++n) {
        const glm::dmat4 before = randomPose(random);
        const glm::dmat4 after = glm::rotate(before, 0.05, glm::normalize(randomVector(random)));
        const PanelFrame frame(before, after, seconds);
        const glm::dvec3 own = randomVector(random);
        const glm::dvec3 from(before * glm::dvec4(own, 1)), to(after * glm::dvec4(own, 1));
        const Moving seen = frame.toPanel({to, (to - from) / seconds});
        ASSERT_LT(glm::distance(seen.place, own), 1e-12);
        ASSERT_LT(glm::length(seen.velocity), 1e-9);
        ASSERT_LT(glm::distance(frame.toPanelBefore(from), own), 1e-12);
    }
}

TEST(SerialSet, RemembersWhatASetWould) {
    MemoryLedger ledger;
    SerialSet set(ledger);
    for (std::uint64_t serial = 0; serial < 10'000; serial += 7) set.insert(serial);
    const std::size_t bytes = ledger.totalBytes();
    set.forgetBelow(5000);
    for (std::uint64_t serial = 5000; serial < 11'000; ++serial)
        ASSERT_EQ(set.contains(serial), serial % 7 == 0 && serial < 10'000) << serial;
    for (std::uint64_t serial = 0; serial < 4900; ++serial) ASSERT_FALSE(set.contains(serial));
    set.forgetBelow(1'000'000);
    set.insert(1'000'001);
    EXPECT_EQ(ledger.totalBytes(), bytes);  // the window moves instead of growing
    EXPECT_TRUE(set.contains(1'000'001));
    EXPECT_FALSE(set.contains(1'000'000));
}

}  // namespace
}  // namespace dustbench::relief
