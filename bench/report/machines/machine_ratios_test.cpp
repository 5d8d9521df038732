#include "bench/report/machines/machine_ratios.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "bench/report/machines/machine_fixture.h"

namespace dustbench::report {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// fog < haze: the ratio stored is that of fog over haze.
constexpr double scatter = 0.01;

/// s² = 6·h²/5 of six logarithms that alternate by ±h, so the half interval is t·h/√5.
double halfInterval(double h) {
    return measure::studentQuantile(0.975, 5) * h / std::sqrt(5);
}

SideRatio ratioWith(double ratio, double low, double high, measure::Verdict verdict) {
    return {{6, ratio, low, high, verdict}, ""};
}

}  // namespace

TEST(MachineRatios, AreThoseOfPairedRunsWithinOneMachine) {
    // The second machine takes 50 times as long, and haze is slower on it.
    const auto comparison =
        compared({{"quick", storedRuns(session(1, 0.5), "A")}, {"slow", storedRuns(session(50, 2), "B")}});
    const MachineExperiment& experiment = comparison.experiments.at(0);
    EXPECT_EQ(experiment.variants.at(0).label, "fog");
    EXPECT_EQ(experiment.variants.at(1).label, "haze");
    ASSERT_THAT(experiment.ratios, SizeIs(1));
    const MachineRatio& ratio = experiment.ratios[0];
    EXPECT_EQ(ratio.column, "frame_ms_median");
    ASSERT_THAT(ratio.worlds, SizeIs(2));
    EXPECT_EQ(worldLabel(experiment, ratio.worlds[0].world), "particles=200");
    for (const RatioRow* row : {&ratio.worlds[0], &ratio.worlds[1], &ratio.all}) {
        const measure::PairedRatio quick = inverted(row->sides.at(0).result), slow = inverted(row->sides.at(1).result);
        EXPECT_NEAR(quick.ratio, 0.5, 1e-9);
        EXPECT_NEAR(quick.low, 0.5 * std::exp(-halfInterval(scatter)), 1e-9);
        EXPECT_NEAR(quick.high, 0.5 * std::exp(halfInterval(scatter)), 1e-9);
        EXPECT_EQ(quick.verdict, measure::Verdict::faster);
        EXPECT_NEAR(slow.ratio, 2, 1e-9);
        EXPECT_NEAR(slow.high, 2 * std::exp(halfInterval(scatter)), 1e-9);
        EXPECT_EQ(slow.verdict, measure::Verdict::slower);
        EXPECT_EQ(quick.pairs, 6u);
        EXPECT_EQ(agreementOf(row->sides), Agreement::differ);
    }
}

TEST(MachineRatios, DoNotDependOnTheOrderOfTheMachines) {
    std::vector<LabelledRuns> machines{{"a", storedRuns(session(1, 0.5), "A")},
                                       {"b", storedRuns(session(3, 0.7, {200}), "B")},
                                       {"c", storedRuns(session(9, 1.5, {200, 1000, 5000}), "C")}};
    for (auto& [id, run] : machines[2].second) run.provenance["git_commit"] = "fedcba9876543210";
    const auto resultsOf = [&](const std::vector<std::size_t>& order) {
        std::vector<LabelledRuns> ordered;
        ordered.reserve(order.size());
        for (const std::size_t index : order) ordered.push_back(machines[index]);
        const MachineComparison comparison = compared(ordered);
        std::map<std::string, std::vector<double>> results;
        const MachineRatio& ratio = ratioOfHaze(comparison);
        std::vector<const RatioRow*> rows{&ratio.all};
        for (const RatioRow& row : ratio.worlds) rows.push_back(&row);
        for (const RatioRow* row : rows)
            for (std::size_t side = 0; side < order.size(); ++side) {
                const measure::PairedRatio& result = row->sides[side].result;
                auto& list = results[comparison.set.sides[side].label];
                list.push_back(static_cast<double>(result.pairs));
                if (result.pairs > 0) list.insert(list.end(), {result.ratio, result.low, result.high});
            }
        for (const MissingCell& missing : comparison.remarks.missing)
            results[missing.cell] = {static_cast<double>(missing.on.size()),
                                     static_cast<double>(missing.lacking.size())};
        for (const auto* list : {&comparison.remarks.apart, &comparison.remarks.notes, &comparison.remarks.programs})
            for (const std::string& sentence : *list) results[sentence] = {};
        return results;
    };
    const auto expected = resultsOf({0, 1, 2});
    EXPECT_EQ(expected, resultsOf({2, 0, 1}));
    EXPECT_EQ(expected, resultsOf({1, 2, 0}));
}

TEST(MachineRatios, OfAllTogetherRestOnTheWorldsThatEveryMachineHas) {
    // Only one machine has 1000 particles, where haze takes four times as long.
    results::StoredRuns more = storedRuns(session(1, 0.5, {200}), "A");
    more.merge(storedRuns(session(1, 4, {1000}), "A"));
    const auto comparison = compared({{"more", more}, {"less", storedRuns(session(1, 0.5, {200}), "B")}});
    const MachineRatio& ratio = ratioOfHaze(comparison);
    EXPECT_EQ(ratio.common, 1u);
    ASSERT_THAT(ratio.worlds, SizeIs(2));
    EXPECT_NEAR(inverted(ratio.all.sides[0].result).ratio, 0.5, 1e-9);
    EXPECT_NEAR(inverted(ratio.all.sides[1].result).ratio, 0.5, 1e-9);
    EXPECT_EQ(ratio.worlds[1].sides[1].reason, "not measured");
    EXPECT_EQ(agreementOf(ratio.worlds[1].sides), Agreement::alone);
}

TEST(MachineRatios, OfSeveralSeedsAreOverThoseThatAllMachinesHave) {
    // On the first machine, the ratio differs for seed 3, which is missing on the other.
    results::StoredRuns first, second;
    for (const int seed : {1, 2, 3}) {
        first.merge(storedRuns(session(1, seed == 3 ? 9 : seed == 1 ? 0.4 : 0.6, {200}, scatter, seed), "A"));
        if (seed < 3) second.merge(storedRuns(session(1, 0.5, {200}, scatter, seed), "B"));
    }
    for (const bool isTurned : {false, true}) {
        const LabelledRuns a{"a", first}, b{"b", second};
        const auto comparison = isTurned ? compared({b, a}) : compared({a, b});
        const std::vector<SideRatio>& sides = ratioOfHaze(comparison).worlds.at(0).sides;
        const SideRatio &ofFirst = sides[isTurned ? 1 : 0], &ofSecond = sides[isTurned ? 0 : 1];
        // Six repetitions of a seed are one turn.
        EXPECT_EQ(ofFirst.result.pairs, 2u);
        EXPECT_NEAR(inverted(ofFirst.result).ratio, std::sqrt(0.4 * 0.6), 1e-9);
        EXPECT_NEAR(inverted(ofSecond.result).ratio, 0.5, 1e-9);
        EXPECT_EQ(ofFirst.reason, "2 paired seeds, 6 are needed");
    }
}

TEST(MachineRatios, AreNotFormedAcrossTheMachinesOfOneFolder) {
    // fog was measured on one machine, haze on another, in one folder.
    results::StoredRuns mixed;
    for (auto& [id, run] : storedRuns(session(1, 0.5, {200}), "A"))
        mixed.emplace(id, id.starts_with("fog") ? run : storedRuns(session(1, 0.5, {200}), "B").at(id));
    const auto comparison = compared({{"mixed", mixed}, {"whole", storedRuns(session(1, 0.5, {200}), "C")}});
    ASSERT_THAT(comparison.set.sides, SizeIs(3));
    EXPECT_EQ(comparison.set.sides[0].label, "mixed (machine 1)");
    const std::vector<SideRatio>& sides = ratioOfHaze(comparison).worlds.at(0).sides;
    EXPECT_EQ(sides[0].result.pairs, 0u);
    EXPECT_EQ(sides[1].result.pairs, 0u);
    EXPECT_EQ(sides[2].result.pairs, 6u);
}

TEST(MachineRatios, NeedRunsThatArePaired) {
    // Repetitions 1..6 of fog, 4..9 of haze.
    std::vector<MadeRun> made = session(1, 0.5, {200});
    for (MadeRun& run : made)
        if (run.method == "haze") run.repetition += 3;
    const auto comparison = compared({{"a", storedRuns(made, "A")}, {"b", storedRuns(session(1, 0.5, {200}), "B")}});
    const SideRatio& side = ratioOfHaze(comparison).worlds.at(0).sides[0];
    EXPECT_EQ(side.result.pairs, 3u);
    EXPECT_EQ(side.result.verdict, measure::Verdict::unresolved);
    EXPECT_EQ(side.reason, "3 paired runs, 6 are needed");
}

TEST(MachineRatios, LeaveOutWorkThatIsNotTheSame) {
    results::StoredRuns other = storedRuns(session(1, 0.5), "B");
    for (auto& [id, run] : other)
        if (run.parameters.at("particles") == "200") run.inputs = {{"scenes/plain.toml", "02"}};
    const auto comparison = compared({{"a", storedRuns(session(1, 0.5), "A")}, {"b", other}});
    const MachineExperiment& experiment = comparison.experiments.at(0);
    ASSERT_THAT(ratioOfHaze(comparison).worlds, SizeIs(1));
    EXPECT_THAT(experiment.axes, IsEmpty());
    EXPECT_THAT(experiment.worlds, SizeIs(1));
    EXPECT_THAT(comparison.remarks.apart,
                ElementsAre("scenes/plain.toml is not the same everywhere: different work was measured in 2 "
                            "configurations, "
                            "whose times are left out"));
}

TEST(MachineRatios, StandBesideTheTimesOfEachMachine) {
    const auto comparison =
        compared({{"a", storedRuns(session(1, 0.5, {200}), "A")}, {"b", storedRuns(session(7, 0.5, {200}), "B")}});
    std::map<std::size_t, double> fogMs;  // by machine
    for (const MachineValue& value : comparison.experiments.at(0).values)
        if (value.column == "frame_ms_median" && value.variant == 0) fogMs[value.side] = value.value.median;
    // The median of six values that grow by 10 %.
    const double median = 200 * (std::pow(1.1, 3) + std::pow(1.1, 4)) / 2;
    EXPECT_NEAR(fogMs.at(0), median, 1e-6);
    EXPECT_NEAR(fogMs.at(1), 7 * median, 1e-6);
}

TEST(Agreement, IsAVerdictThatAllMachinesGive) {
    const SideRatio faster = ratioWith(0.5, 0.49, 0.51, measure::Verdict::faster),
                    muchFaster = ratioWith(0.1, 0.09, 0.11, measure::Verdict::faster),
                    slower = ratioWith(2, 1.9, 2.1, measure::Verdict::slower),
                    open = ratioWith(1, 0.9, 1.1, measure::Verdict::unresolved), none = {{}, "not measured"};
    EXPECT_EQ(agreementOf({faster, faster}), Agreement::agree);
    EXPECT_EQ(agreementOf({faster, muchFaster}), Agreement::factor);
    EXPECT_EQ(agreementOf({muchFaster, faster}), Agreement::factor);
    EXPECT_EQ(agreementOf({faster, open, slower}), Agreement::differ);
    EXPECT_EQ(agreementOf({faster, open}), Agreement::open);
    EXPECT_EQ(agreementOf({faster, none}), Agreement::alone);
    EXPECT_EQ(agreementOf({faster, none, faster}), Agreement::agree);
    using enum claims::ClaimVerdict;
    EXPECT_EQ(agreementOf(std::vector{confirmed, confirmed}), Agreement::agree);
    EXPECT_EQ(agreementOf(std::vector{confirmed, refuted}), Agreement::differ);
    EXPECT_EQ(agreementOf(std::vector{confirmed, depends}), Agreement::differ);
    EXPECT_EQ(agreementOf(std::vector{confirmed, unresolved}), Agreement::open);
    EXPECT_EQ(agreementOf(std::vector{confirmed, notTested}), Agreement::alone);
}

TEST(Agreement, OnClaimsIsByPaperAndClaim) {
    claims::EvaluatedClaim claim;
    claim.paper = "p";
    claim.claim.id = "R1";
    claim.result.verdict = claims::ClaimVerdict::confirmed;
    claims::EvaluatedClaim other = claim, alone = claim;
    other.result.verdict = claims::ClaimVerdict::refuted;
    alone.claim.id = "R2";
    MachineSet set;
    set.folders.resize(2);
    set.folders[0].claims = {claim};
    set.folders[1].claims = {alone, other};
    const std::vector<SharedClaim> shared = sharedClaims(set);
    ASSERT_THAT(shared, SizeIs(2));
    EXPECT_EQ(shared[0].any().claim.id, "R1");
    EXPECT_EQ(shared[0].agreement, Agreement::differ);
    EXPECT_EQ(shared[0].folders[1]->result.verdict, claims::ClaimVerdict::refuted);
    EXPECT_EQ(shared[1].folders[0], nullptr);
    EXPECT_EQ(shared[1].agreement, Agreement::alone);
}

}  // namespace dustbench::report
