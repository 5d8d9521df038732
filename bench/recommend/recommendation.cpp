#include "bench/recommend/recommendation.h"

#include <fmt/format.h>

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::recommend {
namespace {

constexpr double maximumMs = 1e6;
constexpr double millisecondsOfSecond = 1000;

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

bool overlap(const report::MedianInterval& a, const report::MedianInterval& b) {
    return a.low <= b.high && b.low <= a.high;
}

}  // namespace

Budget parseBudget(const std::string& what, const std::string& text) {
    const std::size_t unitAt = text.find_first_not_of("0123456789.+-eE ");
    const std::string unit = unitAt == std::string::npos ? "" : trimmed(text.substr(unitAt));
    const auto number = files::numberOf(trimmed(text.substr(0, unitAt)));
    if (number && *number > 0 && (unit == "ms" || unit == "fps")) {
        const double ms = unit == "ms" ? *number : millisecondsOfSecond / *number;
        if (ms > 0 && ms <= maximumMs) return {ms, text};
    }
    throw InputError(fmt::format("{}: got '{}', allowed: a time (4ms) or a frame rate (60fps); above 0, up to {:g} ms",
                                 what, text, maximumMs));
}

bool fits(const MeasuredSetting& setting, double budgetMs) {
    return setting.ms.high <= budgetMs;
}

Recommendation recommend(const Ranking& ranking, const measure::Metric& quality, double budgetMs) {
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

}  // namespace dustbench::recommend
