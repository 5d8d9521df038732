// Which of the settings of a ranking to take for a budget.
//
// The rule: a setting fits if the upper end of the interval of its own time is within the budget. Of those that fit,
// the best picture leads; all whose intervals of quality overlap the leader's are equally good, and of these the one of
// the lowest median time is recommended. Threads: pure.
#pragma once

#include <optional>
#include <vector>

#include "bench/recommend/rankings.h"

namespace dustbench::bench {

/// Indices are into Ranking::settings.
struct Recommendation {
    std::optional<std::size_t> recommended;  ///< empty: nothing fits
    std::vector<std::size_t> equallyGood;    ///< others that fit, best picture first
    std::size_t cheapest = 0;                ///< by the upper end of the interval
    /// Of those that do not fit and whose picture is better: the one with the best.
    std::optional<std::size_t> betterBeyond;
};

[[nodiscard]] bool fits(const MeasuredSetting& setting, double budgetMs);

/// `ranking` has a setting at least.
[[nodiscard]] Recommendation recommend(const Ranking& ranking, const PictureMetric& quality, double budgetMs);

}  // namespace dustbench::bench
