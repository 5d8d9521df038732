#include "bench/suite/suite_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "bench/suite/suite_axes.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
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

std::string withInterval(const Estimate& estimate) {
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

std::vector<FitResult> fitSuite(const Suite& suite, const StoredRuns& runs) {
    std::vector<FitResult> results;
    for (const PlannedFit& planned : suite.fits) {
        FitResult result{planned.against, {}};
        for (const std::string& column : planned.columns)
            for (const LoadedCells& group : cellsByLoad(suite, planned)) {
                std::vector<CostPoint> points;
                std::size_t invalid = 0;
                for (const PlannedRun* cell : group.cells) {
                    const auto done = doneRuns(*cell, suite.repetitions, runs);
                    const auto valid = validOf(done);
                    invalid += done.size() - valid.size();
                    for (const double number : numbersIn(valid, column))
                        points.push_back({*loadOf(*cell, planned.against), isRate(column) ? 1000 / number : number});
                }
                result.curves.push_back({column, group.label, fitCost(points), invalid});
            }
        results.push_back(std::move(result));
    }
    return results;
}

TextRows tabulate(const FitResult& result) {
    TextRows table{{"column", "method", "a [ms]", "b", "k", "loads", "runs", "scatter", "note"}, {}};
    for (const auto& [column, label, fit, invalid] : result.curves) {
        std::vector<std::string> row{column, label};
        for (const Estimate& estimate : {fit.fixedMs, fit.factor, fit.exponent}) row.push_back(withInterval(estimate));
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

}  // namespace dustbench::bench
