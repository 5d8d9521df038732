#include "bench/report/machines/machine_ratios.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "bench/measure/statistics.h"
#include "bench/results/compared_runs.h"
#include "bench/suite/catalogue.h"
#include "bench/suite/planned_evaluation.h"
#include "bench/suite/suite_cells.h"
#include "methods/kit/files/csv.h"

namespace dustbench::report {
namespace {

using files::numberOf;

/// The runs of a variant in a world on a machine.
using Runs = std::map<std::string, std::map<std::string, const results::StoredRun*>>;  // by seed, then repetition
/// ln(of / with) by seed, then repetition.
using LogRatios = std::map<std::string, std::map<std::string, double>>;
/// The same by repetition, or by seed if there are several.
using Turns = std::map<std::string, double>;

struct Group {
    std::string title, summary;
    std::set<std::string> runs;  ///< ids
    std::vector<std::string> columns{"frame_ms_median", "method_ms_median"};
};

/// The experiments of all folders, by id.
std::map<std::string, Group> groupsOf(const MachineSet& set) {
    std::map<std::string, Group> groups;
    for (const ReportData& folder : set.folders)
        for (const RunGroup& from : folder.groups) {
            Group& group = groups[from.id];
            group.title = from.suite.empty() ? "Runs without a suite" : from.title;
            group.title += !from.suite.empty() && from.id != from.suite ? " (quick)" : "";
            group.summary = from.suite.empty() ? "Runs that belong to no suite of the data folder." : from.summary;
            for (const ReportCell& cell : from.cells)
                for (const results::StoredRun* run : cell.done) group.runs.insert(run->runId);
            for (const suite::ComparisonResult& comparison : from.comparisons)
                for (const suite::ColumnVerdict& column : comparison.columns)
                    if (std::ranges::find(group.columns, column.column) == group.columns.end())
                        group.columns.push_back(column.column);
        }
    return groups;
}

/// The method and its own settings.
suite::CellIdentity variantOf(const suite::CellIdentity& identity) {
    suite::CellIdentity own;
    std::ranges::copy_if(identity, std::back_inserter(own), [](const auto& field) {
        return field.first == "method" ||
               (field.first.starts_with("p.") && !suite::isOfTheWorld(field.first.substr(2)));
    });
    return own;
}

std::string withoutPrefix(const std::string& name) {
    return name.starts_with("p.") ? name.substr(2) : name;
}

/// A time and its logarithm; empty if it is not above 0. Rates count as time per frame.
std::optional<double> logTime(const results::StoredRun& run, const std::string& column) {
    const auto number = suite::numberIn(run, column);
    if (!number || !(*number > 0)) return std::nullopt;
    return suite::isRate(column) ? -std::log(*number) : std::log(*number);
}

LogRatios logRatios(const Runs& of, const Runs& with, const std::string& column) {
    LogRatios ratios;
    for (const auto& [seed, runs] : of) {
        const auto others = with.find(seed);
        if (others == with.end()) continue;
        for (const auto& [repetition, run] : runs)
            if (const auto other = others->second.find(repetition); other != others->second.end())
                if (const auto x = logTime(*run, column), y = logTime(*other->second, column); x && y)
                    ratios[seed][repetition] = *x - *y;
    }
    return ratios;
}

std::set<std::string> commonSeeds(const std::vector<LogRatios>& sides) {
    std::optional<std::set<std::string>> common;
    for (const LogRatios& ratios : sides) {
        if (ratios.empty()) continue;
        std::set<std::string> seeds;
        for (const auto& [seed, values] : ratios)
            if (!common || common->contains(seed)) seeds.insert(seed);
        common = std::move(seeds);
    }
    return common.value_or(std::set<std::string>());
}

Turns turnsOf(const LogRatios& ratios, const std::set<std::string>& seeds) {
    Turns turns;
    for (const auto& [seed, values] : ratios) {
        if (!seeds.contains(seed)) continue;
        double sum = 0;
        for (const auto& [repetition, x] : values) {
            if (seeds.size() == 1) turns["repetition " + repetition] = x;
            sum += x;
        }
        if (seeds.size() > 1) turns["seed " + seed] = sum / static_cast<double>(values.size());
    }
    return turns;
}

SideRatio evaluated(const Turns& turns) {
    std::vector<double> values;
    for (const auto& [turn, x] : turns) values.push_back(x);
    SideRatio ratio{measure::evaluateLogRatios(values), ""};
    if (turns.empty())
        ratio.reason = "not measured";
    else if (turns.size() < measure::minimumPairs)
        ratio.reason = fmt::format("{} paired {}{}, {} are needed", turns.size(),
                                   turns.begin()->first.starts_with("seed") ? "seed" : "run",
                                   turns.size() == 1 ? "" : "s", measure::minimumPairs);
    return ratio;
}

/// The mean over the worlds for each turn that all of them have.
Turns meanTurns(const std::vector<Turns>& worlds) {
    Turns means;
    if (worlds.empty()) return means;
    for (const auto& [turn, first] : worlds.front()) {
        double sum = 0;
        const bool isInAll = std::ranges::all_of(worlds, [&](const Turns& turns) {
            const auto found = turns.find(turn);
            if (found != turns.end()) sum += found->second;
            return found != turns.end();
        });
        if (isInAll) means[turn] = sum / static_cast<double>(worlds.size());
    }
    return means;
}

/// The runs of one experiment by variant, world and machine. Computes its ratios and values.
class Measured {
 public:
    Measured(const Group& group, const MachineCells& cells, std::size_t sides) : group_(group), sides_(sides) {
        for (const MachineCell& cell : cells.cells)
            if (cell.otherWork.empty()) place(cell);
    }

    [[nodiscard]] bool isEmpty() const { return variants_.empty(); }

    void describe(MachineExperiment& experiment) const {
        std::vector<suite::CellIdentity> identities;
        identities.reserve(variants_.size());
        for (const auto& [identity, worlds] : variants_) identities.push_back(identity);
        const std::vector<std::string> names = suite::distinguishingNames(identities);
        for (const suite::CellIdentity& identity : identities)
            experiment.variants.push_back({suite::valueOf(identity, "method"), suite::labelOf(identity, names)});
        for (const std::string& name : varyingNames()) {
            WorldAxis axis{withoutPrefix(name), "", true, {}};
            std::set<std::string> values;
            for (const results::KeyFields& world : worlds_)
                if (std::string value = suite::valueOf(world, name); !value.empty()) values.insert(std::move(value));
            axis.values.assign(values.begin(), values.end());
            axis.numeric =
                std::ranges::all_of(axis.values, [](const std::string& value) { return numberOf(value).has_value(); });
            if (axis.numeric)
                std::ranges::sort(axis.values, {}, [](const std::string& value) { return *numberOf(value); });
            const auto& known = suite::worldParameterList();
            if (const auto found = std::ranges::find(known, axis.name, &Parameter::name); found != known.end())
                axis.unit = found->unit;
            experiment.axes.push_back(std::move(axis));
        }
        for (const results::KeyFields& world : worlds_) {
            experiment.worlds.emplace_back();
            for (const std::string& name : varyingNames())
                experiment.worlds.back().push_back(suite::valueOf(world, name));
        }
    }

    void addRatios(MachineExperiment& experiment) const {
        for (auto of = variants_.begin(); of != variants_.end(); ++of)
            for (auto with = std::next(of); with != variants_.end(); ++with)
                for (const std::string& column : group_.columns)
                    if (MachineRatio ratio = ratioOf(of->second, with->second, column); !ratio.worlds.empty()) {
                        ratio.of = static_cast<std::size_t>(std::distance(variants_.begin(), of));
                        ratio.with = static_cast<std::size_t>(std::distance(variants_.begin(), with));
                        experiment.ratios.push_back(std::move(ratio));
                    }
    }

    void addValues(MachineExperiment& experiment) const {
        std::vector<std::string> columns{"fps_avg"};
        columns.insert(columns.end(), group_.columns.begin(), group_.columns.end());
        for (const std::string& column : columns) {
            std::size_t variant = 0;
            for (const auto& [identity, worlds] : variants_) {
                for (const auto& [world, sides] : worlds)
                    for (const auto& [side, runs] : sides)
                        if (const auto [value, overSeeds] = medianOf(runs, column); value.values > 0)
                            experiment.values.push_back({variant, indexOf(world), side, column, value, overSeeds});
                ++variant;
            }
        }
    }

 private:
    using Worlds = std::map<results::KeyFields, std::map<std::size_t, Runs>, decltype(&suite::identityLess)>;

    void place(const MachineCell& cell) {
        const suite::CellIdentity variant = variantOf(cell.identity);
        if (suite::valueOf(variant, "method") == results::baselineMethod) return;
        for (std::size_t side = 0; side < sides_; ++side)
            for (const results::StoredRun* run : cell.sides[side].done) {
                std::optional<results::KeyFields> world = results::pairKey(*run);
                if (!world || !group_.runs.contains(run->runId)) continue;
                const std::string seed = suite::valueOf(*world, "seed"),
                                  repetition = suite::valueOf(*world, "repetition");
                std::erase_if(*world,
                              [](const auto& field) { return field.first == "seed" || field.first == "repetition"; });
                worlds_.insert(*world);
                variants_.try_emplace(variant, Worlds(&suite::identityLess))
                    .first->second[*world][side][seed]
                    .emplace(repetition, run);
            }
    }

    [[nodiscard]] std::size_t indexOf(const results::KeyFields& world) const {
        return static_cast<std::size_t>(std::distance(worlds_.begin(), worlds_.find(world)));
    }

    /// The fields that differ between worlds, in the order of a run's key.
    [[nodiscard]] std::vector<std::string> varyingNames() const {
        return suite::distinguishingNames(std::vector<suite::CellIdentity>(worlds_.begin(), worlds_.end()));
    }

    [[nodiscard]] MachineRatio ratioOf(const Worlds& of, const Worlds& with, const std::string& column) const {
        MachineRatio ratio{0, 0, column, {}, {}, 0};
        std::vector<std::vector<Turns>> turnsOfWorlds;  // by row, then side
        for (const auto& [world, ofSides] : of) {
            const auto found = with.find(world);
            if (found == with.end()) continue;
            std::vector<LogRatios> logs(sides_);
            for (const auto& [side, runs] : ofSides)
                if (const auto other = found->second.find(side); other != found->second.end())
                    logs[side] = logRatios(runs, other->second, column);
            const std::set<std::string> seeds = commonSeeds(logs);
            if (seeds.empty()) continue;
            RatioRow row{indexOf(world), {}};
            std::vector<Turns> turns;
            for (const LogRatios& ratios : logs) {
                turns.push_back(turnsOf(ratios, seeds));
                row.sides.push_back(evaluated(turns.back()));
            }
            ratio.worlds.push_back(std::move(row));
            turnsOfWorlds.push_back(std::move(turns));
        }
        evaluateAll(turnsOfWorlds, ratio);
        return ratio;
    }

    void evaluateAll(const std::vector<std::vector<Turns>>& worlds, MachineRatio& ratio) const {
        std::vector<bool> has(sides_, false);
        for (const auto& sides : worlds)
            for (std::size_t side = 0; side < sides_; ++side) has[side] = has[side] || !sides[side].empty();
        std::vector<std::vector<Turns>> common(sides_);  // by side, then world
        for (const auto& sides : worlds) {
            bool isEverywhere = true;
            for (std::size_t side = 0; side < sides_; ++side)
                isEverywhere = isEverywhere && (!has[side] || !sides[side].empty());
            if (!isEverywhere) continue;
            ++ratio.common;
            for (std::size_t side = 0; side < sides_; ++side) common[side].push_back(sides[side]);
        }
        for (std::size_t side = 0; side < sides_; ++side) {
            SideRatio all = evaluated(has[side] ? meanTurns(common[side]) : Turns());
            if (has[side] && all.result.pairs == 0)
                all.reason = ratio.common == 0 ? "no world was measured on every machine"
                                               : "no repetition exists in every world";
            ratio.all.sides.push_back(std::move(all));
        }
    }

    static std::pair<MedianInterval, bool> medianOf(const Runs& runs, const std::string& column) {
        std::vector<double> medians, values;
        for (const auto& [seed, repetitions] : runs) {
            values.clear();
            for (const auto& [repetition, run] : repetitions)
                if (const auto value = suite::numberIn(*run, column)) values.push_back(*value);
            if (!values.empty()) medians.push_back(measure::median(values));
        }
        return runs.size() > 1 ? std::pair(medianInterval(medians), true) : std::pair(medianInterval(values), false);
    }

    const Group& group_;
    std::size_t sides_;
    std::map<suite::CellIdentity, Worlds, decltype(&suite::identityLess)> variants_{&suite::identityLess};
    std::set<results::KeyFields, decltype(&suite::identityLess)> worlds_{&suite::identityLess};
};

std::size_t referenceOf(const MachineExperiment& experiment) {
    std::vector<std::size_t> counts(experiment.variants.size(), 0);
    for (const MachineRatio& ratio : experiment.ratios)
        for (const RatioRow& row : ratio.worlds)
            for (const SideRatio& side : row.sides)
                if (side.result.pairs > 0) {
                    ++counts[ratio.of];
                    ++counts[ratio.with];
                }
    return static_cast<std::size_t>(std::ranges::max_element(counts) - counts.begin());
}

}  // namespace

std::string worldLabel(const MachineExperiment& experiment, std::size_t world) {
    std::string label;
    for (std::size_t axis = 0; axis < experiment.axes.size(); ++axis)
        if (const std::string& value = experiment.worlds.at(world).at(axis); !value.empty())
            label += fmt::format("{}{}={}", label.empty() ? "" : " ", experiment.axes[axis].name, value);
    return label;
}

measure::PairedRatio inverted(const measure::PairedRatio& ratio) {
    measure::PairedRatio other{ratio.pairs, 1 / ratio.ratio, 1 / ratio.high, 1 / ratio.low, ratio.verdict};
    if (ratio.verdict == measure::Verdict::faster) other.verdict = measure::Verdict::slower;
    if (ratio.verdict == measure::Verdict::slower) other.verdict = measure::Verdict::faster;
    return other;
}

std::vector<MachineExperiment> compareMachines(const MachineSet& set, const MachineCells& cells) {
    std::vector<MachineExperiment> experiments;
    for (const auto& [id, group] : groupsOf(set)) {
        const Measured measured(group, cells, set.sides.size());
        if (measured.isEmpty()) continue;
        MachineExperiment experiment{.id = id, .title = group.title, .summary = group.summary};
        measured.describe(experiment);
        measured.addRatios(experiment);
        measured.addValues(experiment);
        experiment.reference = referenceOf(experiment);
        experiments.push_back(std::move(experiment));
    }
    // Runs without a suite come last.
    std::ranges::stable_partition(experiments, [](const MachineExperiment& one) { return one.id != "other"; });
    return experiments;
}

}  // namespace dustbench::report
