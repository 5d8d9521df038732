#include "bench/recommend/rankings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "bench/measure/statistics.h"
#include "bench/world/world.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::recommend {
namespace {

using RunList = std::vector<const MeasuredRun*>;
/// Reference and length of runs with metrics.
using Judging = std::pair<std::string, std::string>;

/// All runs of a setting in one world.
struct SettingRuns {
    std::map<SettingTexts, RunList> timed;  ///< by how they were timed
    std::map<Judging, RunList> evaluated;
    bool isRanked = false;
};
using SettingKey = std::pair<std::string, SettingTexts>;
using WorldRuns = std::map<SettingKey, SettingRuns>;
using WorldKey = std::pair<std::size_t, SettingTexts>;

std::map<WorldKey, WorldRuns> sortRuns(const MeasuredRuns& runs, const measure::Metric& quality) {
    std::map<WorldKey, WorldRuns> worlds;
    for (const MeasuredRun& run : runs.runs) {
        SettingRuns& setting = worlds[{run.machine, run.world}][{run.method, run.own}];
        if (run.numbers.contains(timeColumn)) setting.timed[run.conduct].push_back(&run);
        if (run.numbers.contains(quality.column))
            setting.evaluated[{run.reference, run.conduct.at("frames")}].push_back(&run);
    }
    return worlds;
}

/// The mean of two infinities would be no valid median.
constexpr double replacesInfinity = 1e300;

report::MedianInterval intervalOf(std::vector<double> values) {
    for (double& value : values) value = std::min(value, replacesInfinity);
    report::MedianInterval interval = report::medianInterval(std::move(values));
    for (double* end : {&interval.median, &interval.low, &interval.high})
        if (*end >= replacesInfinity / 4) *end = identicalDb;
    return interval;
}

std::map<std::string, std::vector<double>> valuesBySeed(const RunList& runs, std::string_view column) {
    std::map<std::string, std::vector<double>> values;
    for (const MeasuredRun* run : runs)
        if (const auto found = run->numbers.find(column); found != run->numbers.end())
            values[run->seed].push_back(found->second);
    return values;
}

report::MedianInterval overSeeds(const std::map<std::string, std::vector<double>>& bySeed) {
    std::vector<double> medians;
    medians.reserve(bySeed.size());
    for (const auto& [seed, values] : bySeed) medians.push_back(intervalOf(values).median);
    return intervalOf(std::move(medians));
}

void setTime(MeasuredSetting& setting, const RunList& timed) {
    const auto bySeed = valuesBySeed(timed, timeColumn);
    setting.timedSeeds = bySeed.size();
    setting.ms = bySeed.size() == 1 ? intervalOf(bySeed.begin()->second) : overSeeds(bySeed);
}

/// Pictures do not depend on the repetition, so values are taken per seed.
void setMetrics(MeasuredSetting& setting, const RunList& evaluated, const measure::Metric& quality) {
    const auto add = [&](std::string_view column) {
        if (const auto bySeed = valuesBySeed(evaluated, column); !bySeed.empty())
            setting.metrics.emplace(column, overSeeds(bySeed));
    };
    for (const measure::Metric& metric : measure::metrics())
        if (metric.ranks || metric.isFlaw) add(metric.column);
    add("flip");
    setting.quality = setting.metrics.at(std::string(quality.column));
    setting.otherRuns =
        std::ranges::any_of(evaluated, [](const MeasuredRun* run) { return !run->numbers.contains(timeColumn); });
}

/// The length of the runs whose metrics a ranking uses: the one that most settings have, then with most seeds, then the
/// longest.
std::string commonFrames(const WorldRuns& world, const SettingTexts& conduct, const std::string& reference) {
    std::map<std::string, std::pair<std::size_t, std::size_t>> found;  // settings and runs, by frames
    for (const auto& [key, setting] : world)
        if (setting.timed.contains(conduct))
            for (const auto& [metricPlan, runs] : setting.evaluated)
                if (metricPlan.first == reference) {
                    ++found[metricPlan.second].first;
                    found[metricPlan.second].second += valuesBySeed(runs, "flip").size();
                }
    const auto rank = [](const auto& entry) {
        return std::tuple(entry.second, files::numberOf(entry.first).value_or(0));
    };
    const auto best = std::ranges::max_element(found, {}, rank);
    return best == found.end() ? "" : best->first;
}

bool isAhead(const MeasuredSetting& a, const MeasuredSetting& b, const measure::Metric& quality) {
    if (a.quality.median != b.quality.median) return isBetter(a.quality.median, b.quality.median, quality);
    return std::tie(a.ms.median, a.method, a.own) < std::tie(b.ms.median, b.method, b.own);
}

void markFront(std::vector<MeasuredSetting>& settings, const measure::Metric& quality) {
    for (MeasuredSetting& setting : settings)
        setting.onFront = std::ranges::all_of(settings, [&](const MeasuredSetting& other) {
            return &other == &setting || other.ms.low > setting.ms.high ||
                   isClearlyBetter(setting.quality, other.quality, quality);
        });
}

Ranking rankWorld(const WorldKey& key, WorldRuns& world, const SettingTexts& conduct, const std::string& reference,
                  const measure::Metric& quality) {
    Ranking ranking{.world = key.second,
                    .conduct = conduct,
                    .evaluatedFrames = commonFrames(world, conduct, reference),
                    .reference = reference,
                    .machine = key.first};
    for (auto& [settingKey, runs] : world) {
        const auto timed = runs.timed.find(conduct);
        const auto evaluated = runs.evaluated.find({reference, ranking.evaluatedFrames});
        if (timed == runs.timed.end() || evaluated == runs.evaluated.end()) continue;
        MeasuredSetting setting{.method = settingKey.first, .own = settingKey.second};
        setTime(setting, timed->second);
        setMetrics(setting, evaluated->second, quality);
        ranking.settings.push_back(std::move(setting));
        runs.isRanked = true;
    }
    std::ranges::sort(ranking.settings, [&quality](const auto& a, const auto& b) { return isAhead(a, b, quality); });
    markFront(ranking.settings, quality);
    return ranking;
}

std::vector<Ranking> rankWorld(const WorldKey& key, WorldRuns& world, const measure::Metric& quality) {
    std::set<SettingTexts> conducts;
    std::set<std::string> references;
    for (const auto& [settingKey, runs] : world) {
        for (const auto& [conduct, list] : runs.timed) conducts.insert(conduct);
        for (const auto& [metricPlan, list] : runs.evaluated) references.insert(metricPlan.first);
    }
    std::vector<Ranking> rankings;
    for (const SettingTexts& conduct : conducts)
        for (const std::string& reference : references)
            if (Ranking ranking = rankWorld(key, world, conduct, reference, quality); !ranking.settings.empty())
                rankings.push_back(std::move(ranking));
    return rankings;
}

/// Names of settings with several values.
template <typename List, typename SettingsOf>
std::set<std::string> varying(const List& list, const SettingsOf& settingsOf) {
    std::map<std::string, std::set<std::string>> values;
    for (const auto& item : list)
        for (const auto& [name, value] : settingsOf(item)) values[name].insert(value);
    std::set<std::string> names;
    for (const auto& [name, some] : values)
        if (some.size() > 1) names.insert(name);
    return names;
}

bool isDefault(const ParameterSet* declared, const std::string& name, const std::string& value) {
    const Parameter* parameter = declared ? declared->find(name) : nullptr;
    return parameter && parameter->initial == value;
}

/// `name=value` of settings that vary or differ from the default.
std::vector<std::string> distinctSettings(const SettingTexts& settings, const std::set<std::string>& varies,
                                          const ParameterSet* declared) {
    std::vector<std::string> words;
    for (const auto& [name, value] : settings)
        if (varies.contains(name) || !isDefault(declared, name, value)) words.push_back(name + "=" + value);
    return words;
}

std::string ownLabel(const SettingKey& key, const std::set<std::string>& varies) {
    const auto method = std::ranges::find(methods(), key.first, &MethodInfo::id);
    std::vector<std::string> words =
        distinctSettings(key.second, varies, method == methods().end() ? nullptr : &method->parameters);
    words.insert(words.begin(), key.first);
    return fmt::format("{}", fmt::join(words, " "));
}

std::string worldLabel(const SettingTexts& world, const std::set<std::string>& varies) {
    SettingTexts rest = world;
    std::vector<std::string> words;
    for (const char* first : {"scene", "drive", "size"}) {
        words.push_back(fmt::format("{}={}", first, world.at(first)));
        rest.erase(first);
    }
    std::ranges::move(distinctSettings(rest, varies, &world::worldParameters()), std::back_inserter(words));
    return fmt::format("{}", fmt::join(words, " "));
}

void label(std::vector<Ranking>& rankings) {
    const auto worlds = varying(rankings, [](const Ranking& ranking) { return ranking.world; });
    const auto conducts = varying(rankings, [](const Ranking& ranking) { return ranking.conduct; });
    std::map<std::string, std::vector<const MeasuredSetting*>> byMethod;
    for (const Ranking& ranking : rankings)
        for (const MeasuredSetting& setting : ranking.settings) byMethod[setting.method].push_back(&setting);
    std::map<std::string, std::set<std::string>> own;
    for (const auto& [method, settings] : byMethod)
        own[method] = varying(settings, [](const MeasuredSetting* setting) { return setting->own; });
    for (Ranking& ranking : rankings) {
        ranking.label = worldLabel(ranking.world, worlds);
        for (const std::string& name : conducts) ranking.label += " " + name + "=" + ranking.conduct.at(name);
        for (MeasuredSetting& setting : ranking.settings)
            setting.label = ownLabel({setting.method, setting.own}, own[setting.method]);
    }
}

/// Compares numbers as numbers: 500 before 2,000.
bool isBefore(const SettingTexts& a, const SettingTexts& b) {
    return std::ranges::lexicographical_compare(a, b, [](const auto& x, const auto& y) {
        const auto left = files::numberOf(x.second), right = files::numberOf(y.second);
        if (x.first != y.first || !left || !right) return x < y;
        return *left < *right;
    });
}

}  // namespace

std::vector<measure::Metric> qualityMetrics() {
    std::vector<measure::Metric> list = measure::metrics();
    std::erase_if(list, [](const measure::Metric& metric) { return !metric.ranks; });
    std::ranges::stable_sort(list, std::greater(), &measure::Metric::higherIsBetter);  // PSNR, the default, comes first
    return list;
}

std::vector<measure::Metric> flawMetrics() {
    std::vector<measure::Metric> list = measure::metrics();
    std::erase_if(list, [](const measure::Metric& metric) { return !metric.isFlaw; });
    return list;
}

measure::Metric qualityMetric(const std::string& what, const std::string& column) {
    std::vector<std::string_view> names;
    for (const measure::Metric& metric : qualityMetrics()) {
        if (metric.column == column) return metric;
        names.push_back(metric.column);
    }
    throw InputError(fmt::format("{}: got '{}', allowed: {}", what, column, fmt::join(names, ", ")));
}

bool isBetter(double a, double b, const measure::Metric& metric) {
    return metric.higherIsBetter ? a > b : a < b;
}

bool isClearlyBetter(const report::MedianInterval& a, const report::MedianInterval& b, const measure::Metric& metric) {
    return metric.higherIsBetter ? a.low > b.high : a.high < b.low;
}

Rankings rankSettings(const MeasuredRuns& runs, const measure::Metric& quality) {
    Rankings result{.quality = quality, .rankings = {}, .incomplete = {}};
    auto worlds = sortRuns(runs, quality);
    for (auto& [key, world] : worlds)
        std::ranges::move(rankWorld(key, world, quality), std::back_inserter(result.rankings));
    std::ranges::stable_sort(result.rankings, isBefore, &Ranking::world);
    label(result.rankings);
    for (const auto& [key, world] : worlds)
        for (const auto& [settingKey, setting] : world)
            if (!setting.isRanked)
                result.incomplete.push_back({ownLabel(settingKey, {}), worldLabel(key.second, {}),
                                             !setting.timed.empty(), !setting.evaluated.empty()});
    return result;
}

}  // namespace dustbench::recommend
