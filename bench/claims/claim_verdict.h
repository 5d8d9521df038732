// Judges a claim: computes the quantity of its rule with an interval, and the verdict.
//
//     confirmed    the interval lies wholly within the values in which the claim is true
//     refuted      wholly outside
//     unresolved   neither, or fewer than 6 repetitions
//     not-tested   a row that the rule needs is missing; the note says which
//
// If the quantity depends on the machine, each repetition gives one value over all cells (the geometric mean of ratios
// and growths, the mean of shares and values), and the interval is Student's over the repetitions, of logarithms for
// ratios and growths. An exponent has the widest interval of its curves' fits. If it does not (`exact`), the interval
// is the range over the cells: a claim is confirmed if it holds in all of them, refuted if in none. Threads: pure.
// Source: Student1908.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "bench/claims/claim.h"
#include "bench/claims/experiments.h"
#include "bench/claims/result_rows.h"

namespace dustbench::bench {

enum class ClaimVerdict { confirmed, refuted, unresolved, notTested };
/// `confirmed` … `not-tested`
[[nodiscard]] std::string_view verdictName(ClaimVerdict verdict);

struct ClaimResult {
    ClaimVerdict verdict = ClaimVerdict::notTested;
    double measured = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
    std::string note{};               ///< why it is not tested or not resolved
    std::vector<std::string> runs{};  ///< ids of all runs used
};

/// For every quantity except `finding`, for which use judgeFinding:
[[nodiscard]] ClaimResult judgeClaim(const Claim& claim, const ResultRows& rows);
[[nodiscard]] ClaimResult judgeFinding(const Claim& claim, const std::vector<StoredFinding>& findings);

}  // namespace dustbench::bench
