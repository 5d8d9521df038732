// A recommendation as text: for each world the answer, its flaws, and the machines and runs that it is based on.
#pragma once

#include <string>
#include <vector>

#include "bench/recommend/budget.h"
#include "bench/recommend/rankings.h"
#include "bench/recommend/recommendation.h"

namespace dustbench::cli {

/// `recommendations` contains one for each ranking, in the same order.
[[nodiscard]] std::string recommendationText(const bench::Budget& budget, const bench::MeasuredRuns& runs,
                                             const bench::Rankings& rankings,
                                             const std::vector<bench::Recommendation>& recommendations);

/// How many runs are left out, and why; empty if all are used.
[[nodiscard]] std::string leftOutText(const bench::MeasuredRuns& runs);

/// Settings that have a time or a quality but not both, and those that have neither; empty if there are none.
[[nodiscard]] std::string incompleteText(const bench::Rankings& rankings);

}  // namespace dustbench::cli
