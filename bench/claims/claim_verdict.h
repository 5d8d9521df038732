// Evaluates a claim: computes the quantity of its rule with an interval in each cell (configuration) of the experiment,
// and the verdict.
//
// A cell is confirmed if its interval is completely within the values for which the claim is true, refuted if it is
// completely outside, otherwise unresolved. The verdict on all cells:
//
//     confirmed    every cell is confirmed
//     refuted      every cell is refuted; or more than half of them are, the mean over all cells is outside, the mean
//                  of the other cells is outside, and no cell is confirmed by an interval that holds for all cells
//                  together
//     depends      some cells are confirmed and others refuted, each by an interval that holds for all cells together
//     unresolved   anything else
//     untestable   a control gave another verdict than the known one
//     not-tested   a row that the rule needs is missing; the note names it
//
// A claim is a statement about every cell. So counterexamples refute it even if other cells are undecided, but only all
// cells together confirm it.
//
// The 95 % interval of a cell is Student's over the repetitions (at least 6) or seeds (at least 5), of logarithms for
// ratios and growths if all values are above 0. If a denominator is not above 0, which a method's own time may be, the
// ratio is that of the means over all turns, with Fieller's interval (statistics.h). For `depends` the level is
// 1 − 0.05/n for n cells (Bonferroni). An exponent has the interval of its fit, a finding that of its experiment.
// Quantities such as bytes have none. Threads: pure. Source: Student1908, Fieller1954.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "bench/claims/claim.h"
#include "bench/claims/claim_samples.h"
#include "bench/claims/experiments.h"

namespace dustbench::claims {

inline constexpr std::size_t minimumRepetitions = 6;
inline constexpr std::size_t minimumSeeds = 5;

enum class ClaimVerdict { confirmed, refuted, depends, unresolved, untestable, notTested };
/// `confirmed` … `not-tested`
[[nodiscard]] std::string_view verdictName(ClaimVerdict verdict);

enum class ControlState {
    none,       ///< the claim is not testable, so it has no control
    turned,     ///< each control gave its known verdict, and one of these is the opposite of the claim's
    notTurned,  ///< a control gave another verdict, or none can give the opposite
    notRun      ///< the runs of a control are missing
};
/// `turned`, `not-turned`, `not-run`; empty for none.
[[nodiscard]] std::string_view controlName(ControlState state);

struct ClaimCell {
    Selection cell;  ///< columns that vary over the cells, with values; empty for a single cell
    double measured = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no interval
    double high = std::numeric_limits<double>::quiet_NaN();
    std::size_t turns = 0;  ///< repetitions or seeds; 0 for a fit or a finding
    ClaimVerdict verdict = ClaimVerdict::unresolved;
    ClaimVerdict ofAll = ClaimVerdict::unresolved;  ///< by the interval that holds for all cells together
};

/// The rule's result on a control of the claim.
struct ControlResult {
    ClaimVerdict verdict = ClaimVerdict::notTested;  ///< not tested: its runs are missing
    double measured = std::numeric_limits<double>::quiet_NaN();
};

struct ClaimResult {
    ClaimVerdict verdict = ClaimVerdict::notTested;
    double measured = std::numeric_limits<double>::quiet_NaN();  ///< mean over the cells
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
    std::string note{};       ///< why it is not tested or not resolved; data that were left out
    std::string condition{};  ///< in which cells it is true, if only in some
    std::vector<ClaimCell> cells{};
    std::vector<std::string> runs{};  ///< ids of all runs used
    ControlState control = ControlState::none;
    std::string controlNote{};              ///< the result of each control in words
    std::vector<ControlResult> controls{};  ///< the same, in the order of the claim's controls
};

/// Evaluates a rule whose quantity is computed from the rows of a summary.
[[nodiscard]] ClaimResult evaluateRule(const Rule& rule, const ResultRows& rows);
[[nodiscard]] ClaimResult evaluateFinding(const Rule& rule, const std::vector<StoredFinding>& findings);

/// In which cells a claim is true, in words: `true for particles up to 2000, false from 5000`. If no single column
/// separates true cells from false ones, their numbers. With a column `along`: for each combination of the other
/// columns, the values of `along` for which the claim is true, false and undecided.
[[nodiscard]] std::string conditionOf(const std::vector<ClaimCell>& cells, const std::string& along = "");
/// In short: `true for voxel_edge 2 to 4 m, in some configurations for 8 m`, by the verdicts of the cells at each value
/// of the column. Empty if a cell has no number in it.
[[nodiscard]] std::string intervalAlong(const std::vector<ClaimCell>& cells, const std::string& column);

}  // namespace dustbench::claims
