#include "bench/claims/claim_verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "bench/measure/cost_fit.h"
#include "bench/measure/paired_ratio.h"
#include "bench/measure/statistics.h"
#include "methods/contract/choices.h"

namespace dustbench::bench {
namespace {

/// One value of the quantity: for one cell, or pair of cells, in one repetition.
struct Sample {
    std::string cell;
    int repetition = 1;
    double value = 0;
};

/// The measured values, before evaluation.
struct Samples {
    std::vector<Sample> list;
    std::vector<std::size_t> rows;
    std::string missing{};
};

std::string textOf(const Selection& selection) {
    std::string text;
    for (const auto& [column, value] : selection)
        text += (text.empty() ? "" : " ") + (column == "method" ? value : column.substr(2) + "=" + value);
    return text;
}

std::optional<double> valueOf(const Claim& claim, const ResultRows& rows, std::size_t row) {
    const std::optional<double> value = rows.number(row, claim.column);
    if (claim.per.empty() || !value) return value;
    const std::optional<double> divisor = rows.number(row, claim.per);
    return divisor && *divisor != 0 ? std::optional(*value / *divisor) : std::nullopt;
}

void noteMissing(Samples& samples, const Claim& claim, const Selection& selection) {
    if (samples.missing.empty())
        samples.missing =
            fmt::format("no {} of {} in a run of {} that is done", claim.column, textOf(selection), claim.suite);
}

/// The selected rows that have a value in the column.
std::vector<std::size_t> rowsWith(const Claim& claim, const Selection& selection, const ResultRows& rows,
                                  Samples& samples) {
    std::vector<std::size_t> chosen = rows.select(selection);
    std::erase_if(chosen, [&](std::size_t row) { return !valueOf(claim, rows, row); });
    if (chosen.empty()) noteMissing(samples, claim, selection);
    samples.rows.insert(samples.rows.end(), chosen.begin(), chosen.end());
    return chosen;
}

Samples ratios(const Claim& claim, const ResultRows& rows) {
    Samples samples;
    const auto of = rowsWith(claim, claim.of, rows, samples), with = rowsWith(claim, claim.with, rows, samples);
    if (!samples.missing.empty()) return samples;
    std::set<std::string> named;
    for (const Selection* side : {&claim.of, &claim.with})
        for (const auto& [column, value] : *side) named.insert(column);
    for (const std::size_t a : of)
        for (const std::size_t b : with) {
            if (!rows.correspond(a, b, named)) continue;
            const double x = *valueOf(claim, rows, a), y = *valueOf(claim, rows, b);
            if (y > 0 && (x > 0 || claim.exact))
                samples.list.push_back({rows.cellKey(a, ""), rows.repetition(a), x / y});
        }
    if (samples.list.empty())
        samples.missing = fmt::format("no run of {} has its like of {} with a {} above 0", textOf(claim.of),
                                      textOf(claim.with), claim.column);
    return samples;
}

Samples shares(const Claim& claim, const ResultRows& rows) {
    Samples samples;
    for (const std::size_t row : rowsWith(claim, claim.of, rows, samples)) {
        double sum = 0;
        for (const std::string& part : claim.parts) sum += rows.number(row, part).value_or(0);
        if (const double whole = *valueOf(claim, rows, row); whole != 0)
            samples.list.push_back({rows.cellKey(row, ""), rows.repetition(row), sum / whole});
    }
    return samples;
}

Samples values(const Claim& claim, const ResultRows& rows) {
    Samples samples;
    for (const std::size_t row : rowsWith(claim, claim.of, rows, samples))
        samples.list.push_back({rows.cellKey(row, ""), rows.repetition(row), *valueOf(claim, rows, row)});
    return samples;
}

/// The points of each curve: rows that differ only in the load.
std::map<std::string, std::vector<std::size_t>> curves(const Claim& claim, const ResultRows& rows, Samples& samples) {
    std::map<std::string, std::vector<std::size_t>> groups;
    for (const std::size_t row : rowsWith(claim, claim.of, rows, samples))
        if (rows.number(row, claim.against)) groups[rows.cellKey(row, claim.against)].push_back(row);
    return groups;
}

Samples growths(const Claim& claim, const ResultRows& rows) {
    Samples samples;
    for (const auto& [key, members] : curves(claim, rows, samples)) {
        const auto load = [&](std::size_t row) { return *rows.number(row, claim.against); };
        const double minimum = load(*std::ranges::min_element(members, {}, load));
        const double maximum = load(*std::ranges::max_element(members, {}, load));
        if (minimum == maximum) continue;
        for (const std::size_t last : members)
            for (const std::size_t first : members) {
                if (load(last) != maximum || load(first) != minimum) continue;
                const double start = *valueOf(claim, rows, first);
                const double end = *valueOf(claim, rows, last);
                if (rows.repetition(first) == rows.repetition(last) && start > 0 && (end > 0 || claim.exact))
                    samples.list.push_back({key, rows.repetition(first), end / start});
            }
    }
    if (samples.list.empty() && samples.missing.empty())
        samples.missing = fmt::format("{} does not vary in the runs of {}", claim.against, textOf(claim.of));
    return samples;
}

bool isTrueAt(const Claim& claim, double value) {
    return (!claim.minimum || value >= *claim.minimum) && (!claim.maximum || value <= *claim.maximum);
}

ClaimVerdict verdictOf(const Claim& claim, const ClaimResult& result) {
    if (isTrueAt(claim, result.low) && isTrueAt(claim, result.high)) return ClaimVerdict::confirmed;
    const bool below = claim.minimum && result.high < *claim.minimum;
    const bool above = claim.maximum && result.low > *claim.maximum;
    return below || above ? ClaimVerdict::refuted : ClaimVerdict::unresolved;
}

/// Names the cells if they are few enough for one line; `keys` are those of all cells.
std::string listed(const std::vector<std::string>& cells, const std::vector<std::string>& keys, const char* intro,
                   const ResultRows& rows) {
    constexpr std::size_t maximumListed = 3;
    if (cells.size() > maximumListed) return "";
    std::vector<std::string> texts;
    texts.reserve(cells.size());
    for (const std::string& cell : cells) texts.push_back(rows.cellText(cell, keys));
    return fmt::format(": {} {}", intro, fmt::join(texts, "; "));
}

/// Uses the range over the cells, and their mean.
void judgeExact(const Claim& claim, const Samples& samples, bool logarithmic, const ResultRows& rows,
                ClaimResult& result) {
    std::map<std::string, double> byCell;  // the same in every repetition
    for (const Sample& sample : samples.list) byCell.try_emplace(sample.cell, sample.value);
    std::vector<double> list;
    std::vector<std::string> keys, holding, failing;
    for (const auto& [cell, value] : byCell) {
        list.push_back(value);
        keys.push_back(cell);
        (isTrueAt(claim, value) ? holding : failing).push_back(cell);
    }
    const auto [low, high] = std::ranges::minmax(list);
    result.low = low;
    result.high = high;
    double sum = 0;
    for (const double value : list) sum += logarithmic ? std::log(value) : value;
    result.measured = sum / static_cast<double>(list.size());
    if (logarithmic) result.measured = low > 0 ? std::exp(result.measured) : median(list);
    result.verdict = verdictOf(claim, result);
    if (!holding.empty() && !failing.empty()) {
        result.verdict = ClaimVerdict::unresolved;
        result.note = fmt::format("true in {} of {} cells{}", holding.size(), list.size(),
                                  failing.size() <= holding.size() ? listed(failing, keys, "not with", rows)
                                                                   : listed(holding, keys, "only with", rows));
    }
}

/// Uses Student's interval over the repetitions; a repetition counts if all cells have a value.
void judgeRepeated(const Claim& claim, const Samples& samples, bool logarithmic, ClaimResult& result) {
    std::map<int, std::map<std::string, double>> byRepetition;
    std::size_t cells = 0;
    for (const Sample& sample : samples.list) {
        byRepetition[sample.repetition][sample.cell] = logarithmic ? std::log(sample.value) : sample.value;
        cells = std::max(cells, byRepetition[sample.repetition].size());
    }
    std::vector<double> means;
    for (const auto& [repetition, ofCells] : byRepetition)
        if (ofCells.size() == cells)
            means.push_back(std::accumulate(ofCells.begin(), ofCells.end(), 0.0,
                                            [](double sum, const auto& entry) { return sum + entry.second; }) /
                            static_cast<double>(cells));
    const auto count = static_cast<double>(means.size());
    const double mean = std::accumulate(means.begin(), means.end(), 0.0) / count;
    double squares = 0;
    for (const double value : means) squares += (value - mean) * (value - mean);
    const auto back = [&](double value) { return logarithmic ? std::exp(value) : value; };
    result.measured = back(mean);
    if (means.size() > 1) {
        const double half =
            studentQuantile((1 + intervalConfidence) / 2, count - 1) * std::sqrt(squares / (count - 1) / count);
        result.low = back(mean - half);
        result.high = back(mean + half);
    }
    result.verdict = ClaimVerdict::unresolved;
    if (means.size() < minimumPairs)
        result.note = fmt::format("{} complete repetition{}, {} are needed", means.size(), means.size() == 1 ? "" : "s",
                                  minimumPairs);
    else
        result.verdict = verdictOf(claim, result);
}

ClaimResult judgeExponent(const Claim& claim, const ResultRows& rows, Samples& samples) {
    ClaimResult result;
    std::vector<double> exponents;
    for (const auto& [key, members] : curves(claim, rows, samples)) {
        std::vector<CostPoint> points;
        for (const std::size_t row : members)
            points.push_back({*rows.number(row, claim.against), *valueOf(claim, rows, row)});
        const CostFit fit = fitCost(points);
        if (!std::isfinite(fit.exponent.plusMinus)) {
            if (result.note.empty()) result.note = fit.reason.empty() ? "the fit has no interval" : fit.reason;
            continue;
        }
        exponents.push_back(fit.exponent.value);
        const double low = fit.exponent.value - fit.exponent.plusMinus;
        const double high = fit.exponent.value + fit.exponent.plusMinus;
        result.low = exponents.size() == 1 ? low : std::min(result.low, low);
        result.high = exponents.size() == 1 ? high : std::max(result.high, high);
    }
    if (exponents.empty()) {
        result.verdict = samples.missing.empty() ? ClaimVerdict::unresolved : ClaimVerdict::notTested;
        return result;
    }
    result.measured = median(exponents);
    result.verdict = verdictOf(claim, result);
    return result;
}

}  // namespace

std::string_view verdictName(ClaimVerdict verdict) {
    static constexpr Choices<ClaimVerdict> verdicts{{"confirmed", ClaimVerdict::confirmed},
                                                    {"refuted", ClaimVerdict::refuted},
                                                    {"unresolved", ClaimVerdict::unresolved},
                                                    {"not-tested", ClaimVerdict::notTested}};
    return verdicts.wordOf(verdict);
}

ClaimResult judgeClaim(const Claim& claim, const ResultRows& rows) {
    ClaimResult result;
    Samples samples;
    const bool logarithmic = claim.quantity == Quantity::ratio || claim.quantity == Quantity::growth;
    switch (claim.quantity) {
        case Quantity::none:
            result.note = claim.missing;
            return result;
        case Quantity::ratio:
            samples = ratios(claim, rows);
            break;
        case Quantity::share:
            samples = shares(claim, rows);
            break;
        case Quantity::growth:
            samples = growths(claim, rows);
            break;
        case Quantity::value:
            samples = values(claim, rows);
            break;
        case Quantity::finding:
            throw std::invalid_argument("judgeClaim: a finding is not in the rows of a summary");
        case Quantity::exponent:
            result = judgeExponent(claim, rows, samples);
            break;
    }
    if (!samples.missing.empty()) {
        result.note = samples.missing;
        return result;
    }
    if (claim.quantity != Quantity::exponent) {
        if (claim.exact)
            judgeExact(claim, samples, logarithmic, rows, result);
        else
            judgeRepeated(claim, samples, logarithmic, result);
    }
    std::ranges::sort(samples.rows);
    const auto repeated = std::ranges::unique(samples.rows);
    samples.rows.erase(repeated.begin(), repeated.end());
    for (const std::size_t row : samples.rows) result.runs.push_back(rows.runId(row));
    return result;
}

ClaimResult judgeFinding(const Claim& claim, const std::vector<StoredFinding>& findings) {
    ClaimResult result;
    const auto found = std::ranges::find_if(findings, [&](const StoredFinding& finding) {
        return finding.experiment == claim.experiment && finding.quantity == claim.column;
    });
    if (found == findings.end()) {
        result.note = fmt::format("experiments.csv has no {} of the experiment '{}'", claim.column, claim.experiment);
        return result;
    }
    result.measured = found->value;
    result.low = found->low;
    result.high = found->high;
    result.verdict = verdictOf(claim, result);
    return result;
}

}  // namespace dustbench::bench
