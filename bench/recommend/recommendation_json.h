// A recommendation as JSON: `dustbench recommend --json`.
#pragma once

#include <string>
#include <vector>

#include "bench/recommend/budget.h"
#include "bench/recommend/rankings.h"
#include "bench/recommend/recommendation.h"

namespace dustbench::bench {

/// One object with a recommendation for each ranking, in their order. A quality that is not finite, because the picture
/// equals the reference, is null.
[[nodiscard]] std::string recommendationJson(const Budget& budget, const MeasuredRuns& runs, const Rankings& rankings,
                                             const std::vector<Recommendation>& recommendations);

}  // namespace dustbench::bench
