#include "bench/claims/claim_verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "bench/claims/claim_samples.h"
#include "bench/measure/cost_fit.h"
#include "bench/measure/statistics.h"
#include "methods/contract/choices.h"

namespace dustbench::claims {
namespace {

ClaimVerdict verdictOf(const Rule& rule, double low, double high) {
    if (rule.isTrueAt(low) && rule.isTrueAt(high)) return ClaimVerdict::confirmed;
    const bool below = rule.minimum && high < *rule.minimum;
    const bool above = rule.maximum && low > *rule.maximum;
    return below || above ? ClaimVerdict::refuted : ClaimVerdict::unresolved;
}

struct MeanAndError {
    double mean = 0, standardError = 0;
    std::size_t count = 0;

    [[nodiscard]] double half(double level) const {
        return measure::studentQuantile((1 + level) / 2, static_cast<double>(count) - 1) * standardError;
    }
};

MeanAndError meanAndError(const std::vector<double>& values) {
    MeanAndError result;
    result.count = values.size();
    const auto n = static_cast<double>(values.size());
    for (const double value : values) result.mean += value;
    result.mean /= n;
    double squares = 0;
    for (const double value : values) squares += (value - result.mean) * (value - result.mean);
    if (n > 1) result.standardError = std::sqrt(squares / (n - 1) / n);
    return result;
}

/// Values are compared directly or as logarithms. Intervals are clipped to the range of the quantity.
struct Scale {
    bool logarithmic = false;
    double least = -std::numeric_limits<double>::infinity(), most = -least;
    [[nodiscard]] double to(double value) const { return logarithmic ? std::log(value) : value; }
    [[nodiscard]] double from(double value) const {
        return std::clamp(logarithmic ? std::exp(value) : value, least, most);
    }
};

Scale scaleOf(const Rule& rule, const ClaimSamples& samples) {
    const bool isFactor =
        rule.quantity == Quantity::ratio || rule.quantity == Quantity::matched || rule.quantity == Quantity::growth;
    if (rule.quantity == Quantity::trend) return {false, -1, 1};
    return {isFactor && std::ranges::none_of(samples.list, [](const ClaimSample& each) { return each.value <= 0; })};
}

std::size_t minimumTurns(const Rule& rule) {
    if (rule.over == Chance::none) return 1;
    return rule.over == Chance::seeds ? minimumSeeds : minimumRepetitions;
}

const char* turnName(const Rule& rule) {
    return rule.over == Chance::seeds ? "seed" : "repetition";
}

/// The level of each cell's interval such that all intervals together hold with `intervalConfidence` (Bonferroni).
double familyLevel(std::size_t cellCount) {
    return 1 - (1 - measure::intervalConfidence) / static_cast<double>(cellCount);
}

ClaimCell evaluateCell(const Rule& rule, const std::vector<double>& values, const Scale& scale, std::size_t cellCount) {
    ClaimCell cell;
    cell.turns = values.size();
    const MeanAndError found = meanAndError(values);
    cell.measured = scale.from(found.mean);
    if (rule.over == Chance::none) {
        cell.verdict = cell.ofAll = verdictOf(rule, cell.measured, cell.measured);
        return cell;
    }
    if (values.size() < 2) return cell;
    const auto end = [&](double level, int side) { return scale.from(found.mean + side * found.half(level)); };
    cell.low = end(measure::intervalConfidence, -1);
    cell.high = end(measure::intervalConfidence, 1);
    if (values.size() < minimumTurns(rule)) return cell;
    const double level = familyLevel(cellCount);
    cell.verdict = verdictOf(rule, cell.low, cell.high);
    cell.ofAll = verdictOf(rule, end(level, -1), end(level, 1));
    return cell;
}

/// Evaluates the ratio of the means instead of single ratios, if a denominator is not above 0 in some turn.
ClaimCell evaluateRatioNearZero(const Rule& rule, const std::vector<ClaimSample>& samples, std::size_t cellCount) {
    ClaimCell cell;
    cell.turns = samples.size();
    std::vector<std::pair<double, double>> pairs;
    pairs.reserve(samples.size());
    for (const ClaimSample& sample : samples) pairs.emplace_back(sample.numerator, sample.denominator);
    const measure::RatioOfMeans found = measure::ratioOfMeans(pairs, measure::intervalConfidence);
    cell.measured = found.ratio;
    if (rule.over == Chance::none) return cell;
    cell.low = found.low;
    cell.high = found.high;
    if (samples.size() < minimumTurns(rule)) return cell;
    const measure::RatioOfMeans ofAll = measure::ratioOfMeans(pairs, familyLevel(cellCount));
    cell.verdict = verdictOf(rule, found.low, found.high);
    cell.ofAll = verdictOf(rule, ofAll.low, ofAll.high);
    return cell;
}

/// The mean over the cells, with its interval over the turns that have a value in every cell.
void measureAll(const Rule& rule, const ClaimSamples& samples, const Scale& scale, ClaimResult& result) {
    std::map<std::int64_t, std::vector<double>> byTurn;
    for (const ClaimSample& sample : samples.list)
        if (!std::isnan(sample.value)) byTurn[sample.turn].push_back(scale.to(sample.value));
    std::vector<double> means;
    for (const auto& [turn, values] : byTurn)
        if (values.size() == samples.cells.size()) means.push_back(meanAndError(values).mean);
    if (means.empty()) return;
    const MeanAndError found = meanAndError(means);
    result.measured = scale.from(found.mean);
    if (rule.over == Chance::none || means.size() < 2) return;
    result.low = scale.from(found.mean - found.half(measure::intervalConfidence));
    result.high = scale.from(found.mean + found.half(measure::intervalConfidence));
}

std::size_t countOf(const std::vector<ClaimCell>& cells, ClaimVerdict verdict) {
    return static_cast<std::size_t>(std::ranges::count(cells, verdict, &ClaimCell::verdict));
}

/// True if the mean of the cells that are not refuted is outside the range too. It is geometric if all values are above
/// 0.
bool othersAreFalse(const Rule& rule, const std::vector<ClaimCell>& cells) {
    double sum = 0, logarithms = 0, count = 0;
    for (const ClaimCell& cell : cells) {
        if (cell.verdict == ClaimVerdict::refuted) continue;
        sum += cell.measured;
        logarithms += std::log(cell.measured);  // not finite for values of 0 or less
        ++count;
    }
    return !rule.isTrueAt(std::isfinite(logarithms) ? std::exp(logarithms / count) : sum / count);
}

/// `mean`: the verdict on the mean over all cells.
ClaimVerdict verdictOfAll(const Rule& rule, const std::vector<ClaimCell>& cells, ClaimVerdict mean) {
    for (const ClaimVerdict all : {ClaimVerdict::confirmed, ClaimVerdict::refuted})
        if (countOf(cells, all) == cells.size()) return all;
    const bool somewhereTrue = std::ranges::count(cells, ClaimVerdict::confirmed, &ClaimCell::ofAll) > 0;
    const bool somewhereFalse = std::ranges::count(cells, ClaimVerdict::refuted, &ClaimCell::ofAll) > 0;
    if (somewhereTrue && somewhereFalse) return ClaimVerdict::depends;
    const bool mostlyFalse = somewhereFalse && 2 * countOf(cells, ClaimVerdict::refuted) > cells.size();
    if (mostlyFalse && !somewhereTrue && mean == ClaimVerdict::refuted && othersAreFalse(rule, cells))
        return ClaimVerdict::refuted;
    return ClaimVerdict::unresolved;
}

/// Why cells are undecided: too few turns, or intervals that contain both true and false values.
std::string openCells(const Rule& rule, const std::vector<ClaimCell>& cells) {
    const auto smallest = std::ranges::min_element(cells, {}, &ClaimCell::turns);
    if (rule.quantity != Quantity::finding && smallest->turns < minimumTurns(rule))
        return fmt::format("{} {}{}, {} are needed", smallest->turns, turnName(rule), smallest->turns == 1 ? "" : "s",
                           minimumTurns(rule));
    if (cells.size() == 1) return "";
    return fmt::format("of {} cases, {} confirmed, {} refuted", cells.size(), countOf(cells, ClaimVerdict::confirmed),
                       countOf(cells, ClaimVerdict::refuted));
}

void decide(const Rule& rule, ClaimResult& result) {
    result.verdict = verdictOfAll(rule, result.cells, verdictOf(rule, result.low, result.high));
    if (countOf(result.cells, ClaimVerdict::confirmed) > 0 && countOf(result.cells, ClaimVerdict::refuted) > 0)
        result.condition = conditionOf(result.cells, rule.along);
}

/// Some cells are undecided.
bool isPartly(const ClaimResult& result) {
    return result.verdict == ClaimVerdict::unresolved ||
           (result.verdict == ClaimVerdict::refuted &&
            countOf(result.cells, ClaimVerdict::refuted) < result.cells.size());
}

void evaluateSamples(const Rule& rule, const ClaimSamples& samples, ClaimResult& result) {
    const Scale scale = scaleOf(rule, samples);
    std::vector<std::vector<ClaimSample>> samplesOfCell(samples.cells.size());
    for (const ClaimSample& sample : samples.list) samplesOfCell[sample.cell].push_back(sample);
    for (std::size_t i = 0; i < samplesOfCell.size(); ++i) {
        const std::vector<ClaimSample>& list = samplesOfCell[i];
        std::vector<double> values;
        values.reserve(list.size());
        for (const ClaimSample& sample : list) values.push_back(scale.to(sample.value));
        const bool isNearZero = std::ranges::any_of(values, [](double value) { return std::isnan(value); });
        result.cells.push_back(isNearZero ? evaluateRatioNearZero(rule, list, samplesOfCell.size())
                                          : evaluateCell(rule, values, scale, samplesOfCell.size()));
        result.cells.back().cell = samples.cells[i];
    }
    measureAll(rule, samples, scale, result);
    decide(rule, result);
    if (isPartly(result)) result.note = openCells(rule, result.cells);
    const auto add = [&](const std::string& more) { result.note += (result.note.empty() ? "" : "; ") + more; };
    if (samples.undefined > 0) add(fmt::format("{} pairs without a ratio: both are 0", samples.undefined));
    if (samples.unmatched > 0)
        add(fmt::format("{} runs left out: no run of {} has the same {}", samples.unmatched, textOf(rule.with),
                        rule.match));
}

void evaluateCurves(const Rule& rule, const CostCurves& curves, ClaimResult& result) {
    std::vector<double> exponents;
    for (const CostCurve& curve : curves.curves) {
        ClaimCell& cell = result.cells.emplace_back();
        cell.cell = curve.cell;
        const measure::CostFit fit = measure::fitCost(curve.points);
        if (!std::isfinite(fit.exponent.plusMinus)) {
            if (result.note.empty()) result.note = fit.reason.empty() ? "the fit has no interval" : fit.reason;
            continue;
        }
        exponents.push_back(fit.exponent.value);
        cell.measured = fit.exponent.value;
        cell.low = fit.exponent.value - fit.exponent.plusMinus;
        cell.high = fit.exponent.value + fit.exponent.plusMinus;
        cell.verdict = cell.ofAll = verdictOf(rule, cell.low, cell.high);
    }
    result.measured = meanAndError(exponents).mean;
    if (exponents.empty()) result.measured = std::numeric_limits<double>::quiet_NaN();
    if (result.cells.size() == 1) {
        result.low = result.cells[0].low;
        result.high = result.cells[0].high;
    }
    decide(rule, result);
}

/// One of `cellCount` cells. A finding has its own 95 % interval. The interval that holds for all cells together is
/// wider, by the ratio of Student's quantiles.
ClaimCell evaluateOneFinding(const Rule& rule, const StoredFinding& finding, std::size_t cellCount) {
    ClaimCell cell{{}, finding.value, finding.low, finding.high};
    if (cellCount > 1) cell.cell = {{"finding", finding.quantity}};
    cell.verdict = cell.ofAll = verdictOf(rule, finding.low, finding.high);
    if (cellCount == 1 || finding.samples < 2) return cell;
    const auto quantile = [&](double level) {
        return measure::studentQuantile((1 + level) / 2, static_cast<double>(finding.samples) - 1);
    };
    const double wider = quantile(familyLevel(cellCount)) / quantile(measure::intervalConfidence);
    cell.ofAll = verdictOf(rule, finding.value - wider * (finding.value - finding.low),
                           finding.value + wider * (finding.high - finding.value));
    return cell;
}

void takeRuns(const std::vector<std::size_t>& used, const ResultRows& rows, ClaimResult& result) {
    result.runs.reserve(used.size());
    for (const std::size_t row : used) result.runs.push_back(rows.runId(row));
}

}  // namespace

std::string_view verdictName(ClaimVerdict verdict) {
    static constexpr Choices<ClaimVerdict> verdicts{
        {"confirmed", ClaimVerdict::confirmed},   {"refuted", ClaimVerdict::refuted},
        {"depends", ClaimVerdict::depends},       {"unresolved", ClaimVerdict::unresolved},
        {"untestable", ClaimVerdict::untestable}, {"not-tested", ClaimVerdict::notTested}};
    return verdicts.wordOf(verdict);
}

std::string_view controlName(ControlState state) {
    static constexpr Choices<ControlState> states{{"", ControlState::none},
                                                  {"turned", ControlState::turned},
                                                  {"not-turned", ControlState::notTurned},
                                                  {"not-run", ControlState::notRun}};
    return states.wordOf(state);
}

ClaimResult evaluateRule(const Rule& rule, const ResultRows& rows) {
    ClaimResult result;
    if (rule.quantity == Quantity::exponent) {
        const CostCurves curves = costCurvesOf(rule, rows);
        result.note = curves.missing;
        if (!curves.missing.empty()) return result;
        evaluateCurves(rule, curves, result);
        takeRuns(curves.rows, rows, result);
        return result;
    }
    const ClaimSamples samples = samplesOf(rule, rows);
    result.note = samples.missing;
    if (!samples.missing.empty()) return result;
    evaluateSamples(rule, samples, result);
    takeRuns(samples.rows, rows, result);
    return result;
}

ClaimResult evaluateFinding(const Rule& rule, const std::vector<StoredFinding>& findings) {
    ClaimResult result;
    const std::vector<std::string> quantities = alternativesIn(rule.column);
    std::vector<double> values;
    for (const std::string& quantity : quantities) {
        const auto found = std::ranges::find_if(findings, [&](const StoredFinding& finding) {
            return finding.experiment == rule.experiment && finding.quantity == quantity;
        });
        if (found == findings.end()) {
            result.cells.clear();
            result.note = fmt::format("experiments.csv has no {} of the experiment '{}'", quantity, rule.experiment);
            return result;
        }
        if (!found->note.empty()) result.note += (result.note.empty() ? "" : "; ") + found->note;
        if (!std::isfinite(found->value)) {
            result.cells.clear();
            return result;
        }
        result.cells.push_back(evaluateOneFinding(rule, *found, quantities.size()));
        values.push_back(found->value);
    }
    result.measured = meanAndError(values).mean;
    if (result.cells.size() == 1) {
        result.low = result.cells[0].low;
        result.high = result.cells[0].high;
    }
    decide(rule, result);
    if (result.verdict == ClaimVerdict::unresolved && result.cells.size() > 1)
        result.note += (result.note.empty() ? "" : "; ") + openCells(rule, result.cells);
    return result;
}

}  // namespace dustbench::claims
