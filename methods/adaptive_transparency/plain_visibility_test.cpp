#include "methods/adaptive_transparency/plain_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dustbench::adaptive_transparency {
namespace {

using Nodes = std::vector<PlainVisibility::Node>;

/// A fragment of the pixel: its depth and its own transmittance.
struct Inserted {
    double depth, transmittance;
};

std::vector<Inserted> randomFragments(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> depth(1, 30), transmittance(0.4, 1);
    std::vector<Inserted> fragments(count);
    for (Inserted& one : fragments) one = {depth(random), transmittance(random)};
    return fragments;
}

double product(const std::vector<Inserted>& fragments, double depth) {
    double transmittance = 1;
    for (const Inserted& one : fragments)
        if (one.depth < depth) transmittance *= one.transmittance;
    return transmittance;
}

PlainVisibility visibilityOf(std::size_t most, const std::vector<Inserted>& fragments) {
    PlainVisibility visibility(most);
    for (const Inserted& one : fragments) visibility.insert(one.depth, one.transmittance);
    return visibility;
}

void expectNodes(const PlainVisibility& visibility, const Nodes& expected) {
    ASSERT_EQ(visibility.nodes().size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(visibility.nodes()[i].depth, expected[i].depth) << i;
        EXPECT_NEAR(visibility.nodes()[i].transmittance, expected[i].transmittance, 1e-15) << i;
    }
}

TEST(PlainVisibility, IsTheProductOfTheFragmentsInFrontWithAsManyNodes) {
    const std::vector<Inserted> fragments = randomFragments(20, 1);
    const PlainVisibility visibility = visibilityOf(fragments.size(), fragments);
    EXPECT_EQ(visibility.nodes().size(), fragments.size());
    for (const Inserted& one : fragments)
        for (const double depth : {one.depth, one.depth + 1e-9})
            EXPECT_NEAR(visibility.at(depth), product(fragments, depth), 1e-14);
}

TEST(PlainVisibility, OnlyFallsWithDepthAndNeverExceedsTheProduct) {
    for (const std::size_t most : {2u, 3u, 8u}) {
        PlainVisibility visibility(most);
        std::vector<Inserted> before;
        double largestLoss = 0;
        for (const Inserted& one : randomFragments(60, 2)) {
            visibility.insert(one.depth, one.transmittance);
            before.push_back(one);
            ASSERT_EQ(visibility.nodes().size(), std::min(most, before.size()));
            EXPECT_TRUE(std::ranges::is_sorted(visibility.nodes(), std::less{}, &PlainVisibility::Node::depth));
            double last = 1;
            for (double depth = 0.5; depth < 31; depth += 0.1) {
                const double now = visibility.at(depth), exact = product(before, depth);
                EXPECT_LE(now, last);
                EXPECT_LE(now, exact + 1e-14);
                largestLoss = std::max(largestLoss, exact - now);
                last = now;
            }
            EXPECT_NEAR(visibility.total(), product(before, 1e9), 1e-14);
        }
        EXPECT_GT(largestLoss, 0.01) << most;  // so that nodes were removed
    }
}

/// Candidates are the nodes at 4 and 5 m. Their areas are 4·(0.5 − 0.45) = 0.2 and 1·0.45·(1 − transmittance at 5 m).
TEST(PlainVisibility, RemovesTheNodeWithTheSmallerAreaEvenIfItsStepOrGapIsLarger) {
    const double largerStep = 0.6;  // area 0.18
    expectNodes(visibilityOf(3, {{9, 0.5}, {4, 0.9}, {0, 0.5}, {5, largerStep}}), {{0, 0.5}, {4, 0.27}, {9, 0.135}});
    const double largerGap = 0.5;  // area 0.225
    expectNodes(visibilityOf(3, {{9, 0.5}, {4, 0.9}, {0, 0.5}, {5, largerGap}}), {{0, 0.45}, {5, 0.225}, {9, 0.1125}});
}

/// Removing the node at 0 or at 9.001 m would change the area by 10⁻³ at most.
TEST(PlainVisibility, KeepsTheNearestAndTheFarthestNode) {
    expectNodes(visibilityOf(3, {{0, 0.5}, {3, 0.5}, {9, 0.5}, {9.001, 0.5}}),
                {{0, 0.25}, {9, 0.125}, {9.001, 0.0625}});
    expectNodes(visibilityOf(2, {{0, 0.999}, {3, 0.5}, {9, 0.5}}), {{0, 0.4995}, {9, 0.24975}});
    const std::vector<Inserted> fragments = randomFragments(60, 3);
    const auto [nearest, farthest] = std::ranges::minmax(fragments, {}, &Inserted::depth);
    const PlainVisibility visibility = visibilityOf(4, fragments);
    EXPECT_EQ(visibility.nodes().front().depth, nearest.depth);
    EXPECT_EQ(visibility.nodes().back().depth, farthest.depth);
}

}  // namespace
}  // namespace dustbench::adaptive_transparency
