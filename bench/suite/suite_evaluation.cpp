#include "bench/suite/suite_evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "bench/results/compared_runs.h"
#include "bench/suite/suite_cells.h"
#include "methods/contract/errors.h"

namespace dustbench::suite {
namespace {

std::vector<const PlannedRun*> selectedCells(const Suite& suite, const ComparedSide& side) {
    std::vector<const PlannedRun*> cells;
    for (const PlannedRun& cell : suite.cells)
        if (cell.spec.method == side.method && std::ranges::all_of(side.pinned, [&](const auto& entry) {
                return cell.spec.parameters.at(entry.first) == entry.second;
            }))
            cells.push_back(&cell);
    return cells;
}

bool has(const std::vector<Axis>& axes, const std::string& name) {
    return std::ranges::find(axes, name, &Axis::name) != axes.end();
}

std::string ratioText(double ratio) {
    return std::isfinite(ratio) && ratio < 0.1 ? fmt::format("{:.3g}", ratio) : fourDigits(ratio);
}

/// The pair's ln(of / with); empty if a run is missing or has no time above 0.
std::optional<double> logRatio(const CellPair& pair, int repetition, const std::string& column,
                               const results::StoredRuns& runs) {
    const results::StoredRun* of = validRun(*pair.of, repetition, runs);
    const results::StoredRun* with = validRun(*pair.with, repetition, runs);
    if (!of || !with) return std::nullopt;
    const auto a = numberIn(*of, column), b = numberIn(*with, column);
    if (!a || !b || !(*a > 0) || !(*b > 0)) return std::nullopt;
    const double difference = std::log(*a) - std::log(*b);
    return isRate(column) ? -difference : difference;
}

/// The difference between the machines if both runs are done on different ones; else empty.
std::string otherMachine(const CellPair& pair, int repetition, const results::StoredRuns& runs) {
    const results::StoredRun* of = doneRun(*pair.of, repetition, runs);
    const results::StoredRun* with = doneRun(*pair.with, repetition, runs);
    if (!of || !with) return {};
    const auto found = results::differences(*of, *with, results::machineFields());
    if (found.empty()) return {};
    return fmt::format("pairs from different machines were left out ({}: '{}' and '{}')", found.front().field,
                       found.front().first, found.front().second);
}

/// Why a run is invalid if both runs are done; empty if both are valid.
std::string invalidIn(const CellPair& pair, int repetition, const results::StoredRuns& runs) {
    const results::StoredRun* of = doneRun(*pair.of, repetition, runs);
    const results::StoredRun* with = doneRun(*pair.with, repetition, runs);
    if (!of || !with) return {};
    const std::string why = results::whyInvalid(*of);
    return why.empty() ? results::whyInvalid(*with) : why;
}

/// The pairs left out of a verdict, as a clause: those from different machines, and invalid ones with their count.
struct LeftOut {
    std::string machines, whyInvalid;
    std::size_t invalid = 0;

    void addInvalid(const std::string& why) {
        ++invalid;
        if (whyInvalid.empty()) whyInvalid = why;
    }
    [[nodiscard]] std::string text() const {
        if (invalid == 0) return machines;
        return fmt::format("{}{}{} with an invalid run {} left out ({})", machines, machines.empty() ? "" : "; ",
                           invalid == 1 ? "1 pair" : fmt::format("{} pairs", invalid), invalid == 1 ? "was" : "were",
                           whyInvalid);
    }
};

CellVerdict evaluated(std::vector<std::string> at, const std::vector<double>& logRatios, Order order,
                      const LeftOut& leftOut) {
    CellVerdict verdict{std::move(at), measure::evaluateLogRatios(logRatios), ""};
    if (logRatios.empty() && leftOut.invalid == 0)
        verdict.reason = "no paired runs with a time above 0";
    else if (!logRatios.empty() && logRatios.size() < measure::minimumPairs)
        verdict.reason = fmt::format("{} paired {}, {} are needed", logRatios.size(),
                                     logRatios.size() == 1 ? "run" : "runs", measure::minimumPairs);
    if (order == Order::batch) {
        verdict.result.verdict = measure::Verdict::unresolved;
        verdict.reason = "the runs were not interleaved";
    }
    if (const std::string text = leftOut.text(); !text.empty())
        verdict.reason += (verdict.reason.empty() ? "" : "; ") + text;
    return verdict;
}

ColumnVerdict evaluateColumn(const Suite& suite, const MatchedCells& matched, const std::string& column,
                             const results::StoredRuns& runs) {
    ColumnVerdict verdict{column, {}, {}};
    const auto rounds = static_cast<std::size_t>(suite.repetitions);
    std::vector<double> sums(rounds, 0);
    std::vector<std::size_t> counts(rounds, 0);
    std::size_t measured = 0;
    LeftOut leftOutOfAny;
    for (const CellPair& pair : matched.pairs) {
        std::vector<double> logRatios;
        LeftOut leftOut;
        for (std::size_t round = 0; round < rounds; ++round) {
            const int repetition = static_cast<int>(round) + 1;
            if (std::string why = otherMachine(pair, repetition, runs); !why.empty()) {
                leftOut.machines = leftOutOfAny.machines = std::move(why);
            } else if (why = invalidIn(pair, repetition, runs); !why.empty()) {
                leftOut.addInvalid(why);
                leftOutOfAny.addInvalid(why);
            } else if (const auto x = logRatio(pair, repetition, column, runs)) {
                logRatios.push_back(*x);
                sums[round] += *x;
                ++counts[round];
            }
        }
        if (!logRatios.empty()) ++measured;
        verdict.cells.push_back(evaluated(pair.at, logRatios, suite.order, leftOut));
    }
    std::vector<double> means;
    for (std::size_t round = 0; round < rounds; ++round)
        if (measured > 0 && counts[round] == measured) means.push_back(sums[round] / static_cast<double>(measured));
    verdict.overall = evaluated(std::vector<std::string>(matched.axes.size()), means, suite.order, leftOutOfAny);
    return verdict;
}

std::string conclusion(const ComparisonResult& comparison, const ColumnVerdict& column) {
    const measure::PairedRatio& result = column.overall.result;
    std::string text = fmt::format("{}: {} ", column.column, comparison.of);
    if (result.pairs == 0)
        text += fmt::format("against {}", comparison.with);
    else if (result.pairs == 1)
        text += fmt::format("takes {} of the time of {}", ratioText(result.ratio), comparison.with);
    else
        text += fmt::format("takes {} [{}, {}] of the time of {}", ratioText(result.ratio), ratioText(result.low),
                            ratioText(result.high), comparison.with);
    text += fmt::format(": {}", measure::verdictName(result.verdict));
    if (result.verdict == measure::Verdict::same) text += fmt::format(" within {:g} %", measure::sameMargin * 100);
    return text + (column.overall.reason.empty() ? "" : ": " + column.overall.reason);
}

}  // namespace

MatchedCells matchCells(const Suite& suite, const PlannedComparison& comparison) {
    const auto ofCells = selectedCells(suite, comparison.of);
    const auto withCells = selectedCells(suite, comparison.with);
    for (const auto& [side, cells] : {std::pair{&comparison.of, &ofCells}, std::pair{&comparison.with, &withCells}})
        if (cells->empty())
            throw InputError(
                fmt::format("{}compare: got '{}', but no run of the suite matches it", comparison.where, side->label));
    const auto ofSettings = methodAxes(ofCells), withSettings = methodAxes(withCells);
    const auto pinned = [&](const std::string& name) {
        return comparison.of.pinned.contains(name) || comparison.with.pinned.contains(name);
    };
    const auto showTheSame = [&](const results::RunSpec& a, const results::RunSpec& b) {
        return a.scene == b.scene && a.drive == b.drive && a.size.width == b.size.width &&
               a.size.height == b.size.height && std::ranges::all_of(a.parameters, [&](const auto& entry) {
                   const std::string& name = entry.first;
                   if (pinned(name)) return true;
                   if (!isOfTheWorld(name) && !(has(ofSettings, name) && has(withSettings, name))) return true;
                   return b.parameters.at(name) == entry.second;
               });
    };

    MatchedCells matched;
    for (const PlannedRun* of : ofCells)
        for (const PlannedRun* with : withCells)
            if (of != with && showTheSame(of->spec, with->spec)) matched.pairs.push_back({of, with, {}});
    if (matched.pairs.empty())
        throw InputError(fmt::format("{}compare: got '{}' and '{}', which have no different runs in the same world",
                                     comparison.where, comparison.of.label, comparison.with.label));

    // A parameter that a side does not vary is constant there, so the axis comes from the side that varies it.
    const auto addAxes = [&](const std::vector<Axis>& axes, const PlannedRun* CellPair::*side) {
        for (const Axis& axis : axes) {
            const auto valueOf = [&](const CellPair& pair) { return axis.of((pair.*side)->spec); };
            const bool same = std::ranges::all_of(
                matched.pairs, [&](const CellPair& pair) { return valueOf(pair) == valueOf(matched.pairs.front()); });
            if (same || std::ranges::find(matched.axes, axis.name) != matched.axes.end()) continue;
            matched.axes.push_back(axis.name);
            for (CellPair& pair : matched.pairs) pair.at.push_back(valueOf(pair));
        }
    };
    addAxes(worldAxes(ofCells), &CellPair::of);
    addAxes(worldAxes(withCells), &CellPair::with);
    addAxes(ofSettings, &CellPair::of);
    addAxes(withSettings, &CellPair::with);
    return matched;
}

std::vector<ComparisonResult> suiteVerdicts(const Suite& suite, const results::StoredRuns& runs) {
    std::vector<ComparisonResult> results;
    for (const PlannedComparison& comparison : suite.comparisons) {
        const MatchedCells matched = matchCells(suite, comparison);
        ComparisonResult result{comparison.of.label, comparison.with.label, matched.axes, {}};
        for (const std::string& column : comparison.columns)
            result.columns.push_back(evaluateColumn(suite, matched, column, runs));
        results.push_back(std::move(result));
    }
    return results;
}

TextRows tabulate(const ComparisonResult& comparison) {
    TextRows table;
    table.header.emplace_back("column");
    table.header.insert(table.header.end(), comparison.axes.begin(), comparison.axes.end());
    for (const char* name : {"ratio", "low", "high", "pairs", "verdict"}) table.header.emplace_back(name);
    const auto addRow = [&table](const std::string& column, const CellVerdict& cell) {
        std::vector<std::string> row{column};
        row.insert(row.end(), cell.at.begin(), cell.at.end());
        for (const double value : {cell.result.ratio, cell.result.low, cell.result.high})
            row.push_back(ratioText(value));
        row.push_back(fmt::format("{}", cell.result.pairs));
        row.push_back(std::string(measure::verdictName(cell.result.verdict)) +
                      (cell.reason.empty() ? "" : ": " + cell.reason));
        table.rows.push_back(std::move(row));
    };
    for (const ColumnVerdict& column : comparison.columns) {
        for (const CellVerdict& cell : column.cells) addRow(column.column, cell);
        if (column.cells.size() > 1) addRow(column.column + ", all", column.overall);
    }
    return table;
}

std::vector<std::string> conclusions(const ComparisonResult& comparison) {
    std::vector<std::string> sentences;
    sentences.reserve(comparison.columns.size());
    for (const ColumnVerdict& column : comparison.columns) sentences.push_back(conclusion(comparison, column));
    return sentences;
}

namespace {

std::optional<double> loadOf(const PlannedRun& cell, const std::string& parameter) {
    const auto found = cell.spec.parameters.find(parameter);
    if (found == cell.spec.parameters.end()) return std::nullopt;
    const std::string& text = found->second;
    double load = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), load);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return load;
}

std::string withInterval(const measure::Estimate& estimate) {
    if (!std::isfinite(estimate.value)) return "";
    const std::string value = fmt::format("{:.4g}", estimate.value);
    return std::isfinite(estimate.plusMinus) ? fmt::format("{} ± {:.2g}", value, estimate.plusMinus) : value;
}

}  // namespace

std::vector<LoadedCells> cellsByLoad(const Suite& suite, const PlannedFit& fit) {
    std::vector<const PlannedRun*> loaded;
    for (const PlannedRun& cell : suite.cells)
        if (loadOf(cell, fit.against)) loaded.push_back(&cell);
    if (loaded.empty())
        throw InputError(fit.where + "key 'fit.against': got '" + fit.against +
                         "', expected a parameter of the suite's methods that is a number");

    std::vector<Axis> axes = worldAxes(loaded);
    std::ranges::move(methodAxes(loaded), std::back_inserter(axes));
    std::erase_if(axes, [&](const Axis& axis) { return axis.name == fit.against; });
    std::vector<LoadedCells> groups;
    for (const PlannedRun* cell : loaded) {
        const std::string rest = labelOf(axes, cell->spec);
        const std::string label = cell->spec.method + (rest.empty() ? "" : " " + rest);
        auto group = std::ranges::find(groups, label, &LoadedCells::label);
        if (group == groups.end()) group = groups.insert(group, {label, {}});
        group->cells.push_back(cell);
    }
    return groups;
}

std::vector<FitResult> fitSuite(const Suite& suite, const results::StoredRuns& runs) {
    std::vector<FitResult> results;
    for (const PlannedFit& planned : suite.fits) {
        FitResult result{planned.against, {}};
        for (const std::string& column : planned.columns)
            for (const LoadedCells& group : cellsByLoad(suite, planned)) {
                std::vector<measure::CostPoint> points;
                std::size_t invalid = 0;
                for (const PlannedRun* cell : group.cells) {
                    const auto done = doneRuns(*cell, suite.repetitions, runs);
                    const auto valid = validOf(done);
                    invalid += done.size() - valid.size();
                    for (const double number : numbersIn(valid, column))
                        points.push_back({*loadOf(*cell, planned.against), isRate(column) ? 1000 / number : number});
                }
                result.curves.push_back({column, group.label, measure::fitCost(points), invalid});
            }
        results.push_back(std::move(result));
    }
    return results;
}

TextRows tabulate(const FitResult& result) {
    TextRows table{{"column", "method", "a [ms]", "b", "k", "loads", "runs", "scatter", "note"}, {}};
    for (const auto& [column, label, fit, invalid] : result.curves) {
        std::vector<std::string> row{column, label};
        for (const measure::Estimate& estimate : {fit.fixedMs, fit.factor, fit.exponent})
            row.push_back(withInterval(estimate));
        row.push_back(std::to_string(fit.loads));
        row.push_back(std::to_string(fit.runs));
        row.push_back(std::isfinite(fit.relativeError) ? fmt::format("{:.1f} %", 100 * fit.relativeError) : "");
        row.push_back(fit.reason);
        if (invalid > 0)
            row.back() += fmt::format("{}{} invalid {} left out", fit.reason.empty() ? "" : "; ", invalid,
                                      invalid == 1 ? "run" : "runs");
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace dustbench::suite
