#include "bench/recommend/recommendation.h"

#include <algorithm>

namespace dustbench::bench {
namespace {

bool overlap(const MedianInterval& a, const MedianInterval& b) {
    return a.low <= b.high && b.low <= a.high;
}

}  // namespace

bool fits(const MeasuredSetting& setting, double budgetMs) {
    return setting.ms.high <= budgetMs;
}

Recommendation recommend(const Ranking& ranking, const Metric& quality, double budgetMs) {
    const std::vector<MeasuredSetting>& settings = ranking.settings;
    Recommendation result;
    std::vector<std::size_t> good;
    for (std::size_t index = 0; index < settings.size(); ++index) {
        if (settings[index].ms.high < settings[result.cheapest].ms.high) result.cheapest = index;
        if (!fits(settings[index], budgetMs)) continue;
        // Settings are sorted, so the first that fits leads.
        if (good.empty() || overlap(settings[index].quality, settings[good.front()].quality)) good.push_back(index);
    }
    if (!good.empty()) {
        result.recommended =
            *std::ranges::min_element(good, {}, [&](std::size_t index) { return settings[index].ms.median; });
        std::erase(good, *result.recommended);
        result.equallyGood = std::move(good);
    }
    for (std::size_t index = 0; index < settings.size() && !result.betterBeyond; ++index) {
        const bool isBest = !result.recommended || isBetter(settings[index].quality.median,
                                                            settings[*result.recommended].quality.median, quality);
        if (isBest && !fits(settings[index], budgetMs)) result.betterBeyond = index;
    }
    return result;
}

}  // namespace dustbench::bench
