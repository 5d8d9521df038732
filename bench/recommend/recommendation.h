// Chooses a setting of a ranking for a budget.
//
// The rule: a setting fits if the upper end of the interval of its own time is within the budget. Of those that fit,
// the one with the best picture leads. Settings whose intervals of quality overlap the leader's are equally good. Of
// these and the leader, the one with the lowest median time is recommended. Units: ms. Threads: pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/recommend/rankings.h"

namespace dustbench::recommend {

/// The time that a method may add to a frame.
struct Budget {
    double ms = 0;
    std::string asked;  ///< as given: `4ms`, `60fps`
};

/// Reads `4ms`, `0.25 ms`, or a frame rate: `60fps` is 1000/60 ms for the method. Throws InputError that begins with
/// `what`.
[[nodiscard]] Budget parseBudget(const std::string& what, const std::string& text);

/// Indices are into Ranking::settings.
struct Recommendation {
    std::optional<std::size_t> recommended;  ///< empty: nothing fits
    std::vector<std::size_t> equallyGood;    ///< others that fit, best picture first
    std::size_t cheapest = 0;                ///< by the upper end of the interval
    /// The setting with the best picture among those that do not fit and have a better picture.
    std::optional<std::size_t> betterBeyond;
};

[[nodiscard]] bool fits(const MeasuredSetting& setting, double budgetMs);

/// `ranking` must have at least one setting.
[[nodiscard]] Recommendation recommend(const Ranking& ranking, const measure::Metric& quality, double budgetMs);

}  // namespace dustbench::recommend
