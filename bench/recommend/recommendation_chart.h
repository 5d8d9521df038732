// Draws the chart of quality against a method's own time: one panel for each ranking, with the Pareto front and the
// budget.
#pragma once

#include <filesystem>
#include <string>

#include "bench/recommend/budget.h"
#include "bench/recommend/rankings.h"

namespace dustbench::bench {

/// Draws it into a .svg, .png or .pdf. Settings without a finite quality (pictures equal to the reference) are left
/// out; returns their number. Throws InputError that begins with `what` for another ending, for rankings without a
/// setting to draw, and if a drawing program is missing.
std::size_t drawRecommendation(const Rankings& rankings, const MeasuredRuns& runs, const Budget& budget,
                               const std::filesystem::path& file, const std::string& what);

}  // namespace dustbench::bench
