#include "bench/world/moving_solids.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace dustbench::world {
namespace {

constexpr double circle = 2 * std::numbers::pi;

/// Keys at uneven times from 0 on. With `returns`, the last equals the first, up to a whole turn about y.
std::vector<SolidKey> randomSolidKeys(int count, unsigned seed, bool returns = false) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-2, 2);
    std::vector<SolidKey> keys;
    double seconds = 0;
    for (int n = 0; n < count; ++n) {
        const auto three = [&] { return glm::dvec3(number(random), number(random), number(random)); };
        keys.push_back({seconds, three(), three(), {number(random), number(random)}});
        seconds += 0.6 + 0.25 * number(random);
    }
    if (!returns) return keys;
    const double last = keys.back().seconds;
    keys.back() = keys.front();
    keys.back().seconds = last;
    keys.back().turn.y += circle;
    return keys;
}

/// Position of a point of the solid on the path, in double precision.
glm::dvec3 placeOf(const SolidPath& path, double seconds, const glm::dvec3& local) {
    const SolidPath::Moment moment = path.at(seconds);
    return {solidToWorld(moment.position, moment.turn, 1) * glm::dvec4(local, 1)};
}

/// The point's velocity by the pose: v + ω×r.
glm::dvec3 velocityOf(const SolidPath& path, double seconds, const glm::dvec3& local) {
    const scene::SolidPose pose = path.at(seconds).pose(1);
    const glm::dvec3 arm = placeOf(path, seconds, local) - placeOf(path, seconds, {});
    return glm::dvec3(pose.velocity) + glm::cross(glm::dvec3(pose.angularVelocity), arm);
}

TEST(SolidPath, VelocitiesAreTheDerivativesOfPlacesToSecondOrder) {
    const glm::dvec3 local(0.3, -0.5, 0.8);
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const std::vector<SolidKey> keys = randomSolidKeys(6, seed, seed % 2 == 0);
        const SolidPath path(keys, seed % 2 == 0);
        double coarse = 0, fine = 0, speed = 0, ofWeights = 0;
        for (std::size_t k = 0; k + 1 < keys.size(); ++k)
            for (const double share : {0.2, 0.5, 0.8}) {
                const double at = keys[k].seconds + share * (keys[k + 1].seconds - keys[k].seconds);
                const auto off = [&](double h) {
                    const glm::dvec3 way = placeOf(path, at + h, local) - placeOf(path, at - h, local);
                    return glm::distance(way / (2 * h), velocityOf(path, at, local));
                };
                speed = std::max(speed, glm::length(velocityOf(path, at, local)));
                coarse += off(0.02);
                fine += off(0.01);
                const double rate = (path.at(at + 1e-5).weights[1] - path.at(at - 1e-5).weights[1]) / 2e-5;
                ofWeights = std::max(ofWeights, std::abs(rate - path.at(at).weightsPerSecond[1]));
            }
        EXPECT_GT(speed, 1);
        EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << seed;
        EXPECT_LT(ofWeights, 1e-6);
    }
}

TEST(SolidPath, VelocitiesAreContinuousAtKeysAndAtTheSeamOfARepetition) {
    const glm::dvec3 local(0.3, -0.5, 0.8);
    for (const bool repeats : {false, true}) {
        const std::vector<SolidKey> keys = randomSolidKeys(5, 7, repeats);
        const SolidPath path(keys, repeats);
        for (const SolidKey& key : keys) {
            const double before = key.seconds - 1e-9, after = key.seconds + 1e-9;
            EXPECT_LT(glm::distance(placeOf(path, before, local), placeOf(path, after, local)), 1e-7) << key.seconds;
            EXPECT_LT(glm::distance(velocityOf(path, before, local), velocityOf(path, after, local)), 1e-5)
                << key.seconds << repeats;
        }
        EXPECT_LT(glm::distance(placeOf(path, keys[2].seconds, {}), keys[2].position), 1e-12);
    }
}

TEST(SolidPath, RestsBeforeItsFirstKeyAndAfterItsLastOrRepeats) {
    const std::vector<SolidKey> keys = randomSolidKeys(4, 3, true);
    const SolidPath once(keys, false), again(keys, true);
    const double last = keys.back().seconds;
    for (const double seconds : {-5.0, 0.0, last, last + 3}) {
        EXPECT_EQ(once.at(seconds).velocity, glm::dvec3(0)) << seconds;
        EXPECT_EQ(once.at(seconds).turnPerSecond, glm::dvec3(0)) << seconds;
        EXPECT_LT(glm::distance(once.at(seconds).position, keys.front().position), 1e-12);
    }
    for (const double seconds : {0.3, 1.1})
        for (const double periods : {-2.0, 1.0, 3.0})
            EXPECT_LT(
                glm::distance(placeOf(again, seconds, {1, 2, 3}), placeOf(again, seconds + periods * last, {1, 2, 3})),
                1e-9);
}

TEST(SolidPath, TwoKeysAWholeTurnApartTurnEvenlyWhileTheyRepeat) {
    const SolidPath path({{0, {}, {}}, {4, {}, {0, circle, 0}}}, true);
    for (const double seconds : {-3.0, 0.0, 0.7, 2.0, 3.9, 11.0}) {
        const scene::SolidPose pose = path.at(seconds).pose(2);
        EXPECT_NEAR(pose.angularVelocity.y, static_cast<float>(circle / 4), 1e-6f);
        EXPECT_EQ(pose.angularVelocity.x, 0);
        // A quarter turn a second, counter-clockwise seen from above: +X goes to −Z.
        const glm::vec3 x(pose.toWorld[0]);
        EXPECT_NEAR(x.x, 2 * std::cos(circle / 4 * seconds), 1e-5);
        EXPECT_NEAR(x.z, -2 * std::sin(circle / 4 * seconds), 1e-5);
    }
}

TEST(SolidPath, WhatStandsStillIsExactlyWhereItsKeysAre) {
    const SolidKey key{0, {0.1, 0.7, -3.3}, {0.2, 1.9, -0.4}, {0.3}};
    std::vector<SolidKey> keys{key, key, key};
    keys[1].seconds = 0.7;
    keys[2].seconds = 1.9;
    for (const bool repeats : {false, true}) {
        const SolidPath path(keys, repeats);
        for (int step = -20; step < 200; ++step) {
            const SolidPath::Moment moment = path.at(step / 60.0);
            EXPECT_EQ(moment.weights[0], 0.3);
            const scene::SolidPose pose = moment.pose(0.9);
            EXPECT_EQ(pose.toWorld, glm::mat4(solidToWorld(key.position, key.turn, 0.9)));
            EXPECT_EQ(pose.velocity, glm::vec3(0));
            EXPECT_EQ(pose.angularVelocity, glm::vec3(0));
        }
    }
}

TEST(SolidPath, RefusesWhatIsNoPath) {
    const SolidKey rest{}, later{1, {}, {}}, away{2, {1, 0, 0}, {}}, other{2, {}, {}, {1}};
    const auto path = [](const std::vector<SolidKey>& keys, bool repeats) { return SolidPath(keys, repeats); };
    EXPECT_THROW(path({}, false), std::invalid_argument);
    EXPECT_THROW(path({later, rest}, false), std::invalid_argument);
    EXPECT_THROW(path({rest, other}, false), std::invalid_argument);
    EXPECT_THROW(path({rest}, true), std::invalid_argument);
    EXPECT_THROW(path({rest, away}, true), std::invalid_argument);
    EXPECT_NO_THROW(path({rest, later}, true));
}

}  // namespace
}  // namespace dustbench::world
