// Claims that are decided by the findings of experiments, without runs.
#include <gtest/gtest.h>

#include "bench/claims/claim_verdict.h"

namespace dustbench::bench {
namespace {

TEST(ClaimFindings, AreJudgedByTheirOwnInterval) {
    const Claim claim = parseClaims(
                            "[[claim]]\nid = \"X\"\ntext = \"t\"\nquantity = \"finding\"\nexperiment = \"sampling\"\n"
                            "column = \"acceptance\"\nmin = 0.53\nreason = \"r\"\n",
                            "claims.toml")
                            .at(0);
    const auto evaluatedAt = [&](double value) {
        StoredFinding finding;
        finding.experiment = "sampling";
        finding.quantity = "acceptance";
        finding.value = value;
        finding.low = value - 0.01;
        finding.high = value + 0.01;
        return evaluateFinding(claim.rule, {finding}).verdict;
    };
    EXPECT_EQ(evaluatedAt(0.55), ClaimVerdict::confirmed);
    EXPECT_EQ(evaluatedAt(0.51), ClaimVerdict::refuted);
    EXPECT_EQ(evaluatedAt(0.535), ClaimVerdict::unresolved);
    const ClaimResult untested = evaluateFinding(claim.rule, {});
    EXPECT_EQ(untested.verdict, ClaimVerdict::notTested);
    EXPECT_EQ(untested.note, "experiments.csv has no acceptance of the experiment 'sampling'");
}

TEST(ClaimFindings, OfSeveralShapesAreCells) {
    const Claim claim = parseClaims(
                            "[[claim]]\nid = \"X\"\ntext = \"t\"\nquantity = \"finding\"\nexperiment = \"sampling\"\n"
                            "column = \"kept_car|kept_bunny\"\nmin = 0.9\nreason = \"r\"\n",
                            "claims.toml")
                            .at(0);
    const auto found = [](const char* quantity, double value, double half, std::int64_t samples) {
        StoredFinding finding;
        finding.experiment = "sampling";
        finding.quantity = quantity;
        finding.value = value;
        finding.low = value - half;
        finding.high = value + half;
        finding.samples = samples;
        return finding;
    };
    const auto evaluatedAt = [&](double car, double bunny, double half, std::int64_t samples) {
        return evaluateFinding(claim.rule,
                               {found("kept_bunny", bunny, half, samples), found("kept_car", car, half, samples)});
    };
    EXPECT_EQ(evaluatedAt(0.95, 0.99, 0.01, 5).verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(evaluatedAt(0.80, 0.85, 0.01, 5).verdict, ClaimVerdict::refuted);
    EXPECT_EQ(evaluatedAt(0.95, 0.905, 0.01, 5).note, "of 2 cases, 1 confirmed, 0 refuted");
    const ClaimResult mixed = evaluatedAt(0.95, 0.80, 0.01, 5);
    EXPECT_EQ(mixed.verdict, ClaimVerdict::depends);
    EXPECT_EQ(mixed.condition, "true for finding kept_car, false with kept_bunny");
    EXPECT_NEAR(mixed.measured, 0.875, 1e-12);
    // Two cells widen an interval by 1.14 for many samples, and by 1.44 for three.
    EXPECT_EQ(evaluatedAt(0.95, 0.889, 0.01, 3).verdict, ClaimVerdict::unresolved);
    EXPECT_EQ(evaluatedAt(0.95, 0.889, 0.01, 100000).verdict, ClaimVerdict::unresolved);
    EXPECT_EQ(evaluatedAt(0.95, 0.887, 0.01, 100000).verdict, ClaimVerdict::depends);
    EXPECT_EQ(evaluatedAt(0.95, 0.887, 0.01, 3).verdict, ClaimVerdict::unresolved);
    EXPECT_EQ(evaluateFinding(claim.rule, {found("kept_car", 1, 0, 5)}).note,
              "experiments.csv has no kept_bunny of the experiment 'sampling'");
}

}  // namespace
}  // namespace dustbench::bench
