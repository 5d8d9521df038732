#include "methods/kit/particles/part_costs_experiment.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace dustbench::particles::part_costs {
namespace {

TEST(PartCostsExperiment, HasEveryFindingOnceAndFindsTheSameHits) {
    std::map<std::string, Finding> found;
    for (const Finding& finding : measurePartCosts(1, {1000, 20'000, 2})) {
        EXPECT_TRUE(found.emplace(finding.quantity, finding).second) << finding.quantity;
        EXPECT_GT(finding.low, 0) << finding.quantity;
        EXPECT_LE(finding.low, finding.value);
        EXPECT_LE(finding.value, finding.high);
    }
    EXPECT_EQ(found.size(), 18u);
    // In either direction: paths · length · area / (2 · volume) = 20,000 · 0.1 · 4π / (2 · 216) = 58.
    EXPECT_NEAR(static_cast<double>(found.at("hits_of_tree").samples), 58, 25);
    EXPECT_EQ(found.at("hits_of_sphere").value, 1);
    EXPECT_EQ(found.at("hits_of_tree").value, 1);
}

}  // namespace
}  // namespace dustbench::particles::part_costs
