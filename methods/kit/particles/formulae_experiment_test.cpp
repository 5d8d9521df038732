#include "methods/kit/particles/formulae_experiment.h"

#include <gtest/gtest.h>

#include <map>

namespace dustbench::particles::formulae {
namespace {

TEST(FormulaeExperiment, FindsTheClosedForms) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        std::map<std::string, Finding> found;
        for (Finding& finding : measureFormulae(seed, 10'000)) found[finding.quantity] = finding;
        EXPECT_EQ(found.size(), 12u);
        // 8·P_0 + 12·P_1 + 6·P_2 beyond P_3, of uniform values: mean 13, variance (64 + 144 + 36)/12, over 10,000
        // curves. Four standard errors.
        EXPECT_NEAR(found["bezier_end_printed"].value, 13, 4 * 4.51 / 100);
        EXPECT_EQ(found["bezier_end_mended"].value, 0);
        EXPECT_NEAR(found["bezier_end_printed_2"].value, 0, 1e-12);
        EXPECT_LT(found["bezier_six_by_sum"].value, 1e-6);
        EXPECT_GT(found["bezier_six_printed"].value, 100);
        // Σ C(N, i)·(N − t)^(N−i)·t^i = N^N.
        EXPECT_NEAR(found["bezier_equal_printed"].value, 27, 1e-9);
        EXPECT_NEAR(found["bezier_equal_mended"].value, 1, 1e-6);
        EXPECT_EQ(found["acceleration_2kg_printed"].value, 2);
        EXPECT_EQ(found["acceleration_2kg_mended"].value, 0.5);
        EXPECT_NEAR(found["momentum_2kg_printed"].value, 4, 1e-12);
        EXPECT_NEAR(found["momentum_2kg_mended"].value, 1, 1e-12);
        EXPECT_NEAR(found["momentum_1kg_printed"].value, 1, 1e-12);
        for (const auto& [name, finding] : found) {
            EXPECT_LE(finding.low, finding.value) << name;
            EXPECT_GE(finding.high, finding.value) << name;
        }
    }
}

TEST(FormulaeExperiment, IsAFunctionOfItsSeed) {
    const auto first = [](std::uint64_t seed) { return measureFormulae(seed, 100).front().value; };
    EXPECT_EQ(first(1), first(1));
    EXPECT_NE(first(1), first(2));
}

}  // namespace
}  // namespace dustbench::particles::formulae
