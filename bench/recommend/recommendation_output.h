// What `dustbench recommend` gives besides its text: JSON, and a chart of quality against a method's own time, with one
// panel for each ranking, the Pareto front and the budget.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/recommend/rankings.h"
#include "bench/recommend/recommendation.h"

namespace dustbench::recommend {

/// One object with a recommendation for each ranking, in their order. A quality that is not finite, because the picture
/// equals the reference, is null.
[[nodiscard]] std::string recommendationJson(const Budget& budget, const MeasuredRuns& runs, const Rankings& rankings,
                                             const std::vector<Recommendation>& recommendations);

/// Draws the chart into a .svg, .png or .pdf. Settings without a finite quality (pictures equal to the reference) are
/// left out; returns their number. Throws InputError that begins with `what` for another ending, for rankings without a
/// setting to draw, and if a drawing program is missing.
std::size_t drawRecommendation(const Rankings& rankings, const MeasuredRuns& runs, const Budget& budget,
                               const std::filesystem::path& file, const std::string& what);

}  // namespace dustbench::recommend
