// Judges a claim: computes the quantity of its rule in each cell of the experiment with an interval, and the verdict.
//
// A cell is confirmed if its interval lies wholly within the values in which the claim is true, refuted if wholly
// outside, else unresolved. All cells together:
//
//     confirmed    in every cell
//     refuted      in every cell; or in more than half of them, if the mean over all cells lies outside too, the mean
//                  of the other cells as well, and no cell is confirmed by an interval that holds for all cells
//                  together
//     depends      confirmed in some cells and refuted in others, each by an interval that holds for all cells together
//     unresolved   anything else
//     untestable   a control gave another verdict than is known for it
//     not-tested   a row that the rule needs is missing; the note says which
//
// A claim is a statement on every cell, so counterexamples refute it although other cells are open; nothing but all
// cells confirms it.
//
// The 95 % interval of a cell is Student's over the repetitions (at least 6) or seeds (at least 5), of logarithms for
// ratios and growths if all values are above 0. A ratio of which a denominator is not above 0, as a method's own time
// may be, is that of the means over all turns, with Fieller's interval (ratio_of_means.h). For `depends` the level is
// 1 − 0.05/n for n cells (Bonferroni). An exponent's interval is its fit's, a finding's that of its experiment. Bytes
// and the like have none. Threads: pure. Source: Student1908, Fieller1954.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "bench/claims/claim.h"
#include "bench/claims/experiments.h"
#include "bench/claims/result_rows.h"

namespace dustbench::bench {

inline constexpr std::size_t minimumRepetitions = 6;
inline constexpr std::size_t minimumSeeds = 5;

enum class ClaimVerdict { confirmed, refuted, depends, unresolved, untestable, notTested };
/// `confirmed` … `not-tested`
[[nodiscard]] std::string_view verdictName(ClaimVerdict verdict);

enum class ControlState {
    none,       ///< the claim is not testable, so it has no control
    turned,     ///< each control gave what is known, one of them the opposite of the claim's own verdict
    notTurned,  ///< a control gave something else, or none can give the opposite
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

/// What the rule gave on a control of the claim.
struct ControlResult {
    ClaimVerdict verdict = ClaimVerdict::notTested;  ///< not tested: its runs are missing
    double measured = std::numeric_limits<double>::quiet_NaN();
};

struct ClaimResult {
    ClaimVerdict verdict = ClaimVerdict::notTested;
    double measured = std::numeric_limits<double>::quiet_NaN();  ///< mean over the cells
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
    std::string note{};       ///< why it is not tested or not resolved; what its experiment left out
    std::string condition{};  ///< in which cells it is true, if in some only
    std::vector<ClaimCell> cells{};
    std::vector<std::string> runs{};  ///< ids of all runs used
    ControlState control = ControlState::none;
    std::string controlNote{};              ///< what each control gave, in words
    std::vector<ControlResult> controls{};  ///< the same, in the order of the claim's controls
};

/// Judges a rule whose quantity is computed from the rows of a summary.
[[nodiscard]] ClaimResult judgeRule(const Rule& rule, const ResultRows& rows);
[[nodiscard]] ClaimResult judgeFinding(const Rule& rule, const std::vector<StoredFinding>& findings);

/// In which cells a claim is true, in words: `true for particles up to 2000, false from 5000`. If no single column
/// tells true cells from false ones, their numbers. With a column `along`, a map: for each combination of the others
/// where along it the claim is true, false and open.
[[nodiscard]] std::string conditionOf(const std::vector<ClaimCell>& cells, const std::string& along = "");

}  // namespace dustbench::bench
