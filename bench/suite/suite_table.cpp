#include "bench/suite/suite_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/measure/image/metric.h"
#include "bench/measure/statistics.h"
#include "bench/suite/suite_cells.h"
#include "methods/contract/stage_clock.h"

namespace dustbench::suite {
namespace {

using Row = std::vector<std::string>;

std::string oneDecimal(double value) {
    return std::isfinite(value) ? fmt::format("{:.1f}", value) : "";
}

Row timesHeader(bool withOwn) {
    Row names{"fps", "min", "max", "frame"};
    if (withOwn) names.emplace_back("own");
    for (const std::string_view stage : stageNames) names.emplace_back(stage);
    return names;
}

Row timesOf(const std::vector<const results::StoredRun*>& done, bool withOwn) {
    const auto fps = numbersIn(done, "fps_avg");
    Row row;
    for (const double value : {measure::median(fps), measure::quantile(fps, 0), measure::quantile(fps, 1)})
        row.push_back(oneDecimal(value));
    row.push_back(fourDigits(measure::median(numbersIn(done, "frame_ms_median"))));
    if (withOwn) row.push_back(fourDigits(measure::median(numbersIn(done, "method_ms_median"))));
    for (const std::string_view stage : stageNames)
        row.push_back(fourDigits(measure::median(numbersIn(done, fmt::format("{}_ms_median", stage)))));
    return row;
}

std::string threeDigitsIfSmall(double value) {
    return value != 0 && std::abs(value) < 0.0995 ? fmt::format("{:.3g}", value) : fourDigits(value);
}

/// Metrics of the first repetition, the only one that has them.
Row metricsOf(const std::vector<const results::StoredRun*>& done) {
    Row row;
    for (const measure::Metric& metric : measure::metrics()) {
        const auto values = numbersIn(done, metric.column);
        const double value = values.empty() ? std::numeric_limits<double>::quiet_NaN() : values.front();
        row.push_back(threeDigitsIfSmall(value));
    }
    return row;
}

/// ` (2 of 6 invalid)`; empty if all are valid.
std::string invalidMark(const std::vector<const results::StoredRun*>& done) {
    const std::size_t count = done.size() - validOf(done).size();
    return count == 0 ? "" : fmt::format(" ({} of {} invalid)", count, done.size());
}

Row joined(Row row, Row more) {
    row.insert(row.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    return row;
}

/// The configurations by world, in order of first appearance in the suite.
std::vector<std::pair<std::string, std::vector<const PlannedRun*>>> groupByWorld(
    const std::vector<const PlannedRun*>& cells, const std::vector<Axis>& world) {
    std::vector<std::pair<std::string, std::vector<const PlannedRun*>>> groups;
    for (const PlannedRun* cell : cells) {
        const std::string label = labelOf(world, cell->spec);
        auto group = std::ranges::find(groups, label, [](const auto& entry) { return entry.first; });
        if (group == groups.end()) group = groups.insert(group, {label, {}});
        group->second.push_back(cell);
    }
    return groups;
}

/// `numbersOf` returns the table cells under `numberHeader` for the runs of a configuration.
template <typename NumbersOf>
TextRows tabulateRuns(const Suite& suite, const results::StoredRuns& runs, const Row& numberHeader,
                      const NumbersOf& numbersOf) {
    TextRows table;
    const auto cells = cellsOf(suite);
    if (cells.empty()) return table;
    const auto world = worldAxes(cells);
    const auto settings = methodAxes(cells);
    const auto nameOf = [&](const PlannedRun& cell, const std::vector<const results::StoredRun*>& done) {
        std::string name = cell.spec.method;
        if (const std::string setting = labelOf(settings, cell.spec); !setting.empty()) name += " " + setting;
        if (done.size() < static_cast<std::size_t>(suite.repetitions))
            name += fmt::format(" ({} of {} runs)", done.size(), suite.repetitions);
        return name + invalidMark(done);
    };
    const auto groups = groupByWorld(cells, world);
    const bool inColumns = std::ranges::all_of(groups, [](const auto& group) { return group.second.size() == 1; });

    table.header.emplace_back("method");
    if (inColumns)
        for (const Axis& axis : world) table.header.push_back(axis.name);
    table.header = joined(std::move(table.header), numberHeader);

    for (const auto& [label, members] : groups) {
        const bool headed = !inColumns && !label.empty();
        if (headed) {
            table.rows.push_back({label});
            table.rows.back().resize(table.header.size());
        }
        for (const PlannedRun* cell : members) {
            const auto done = doneRuns(*cell, suite.repetitions, runs);
            Row row{(headed ? "  " : "") + nameOf(*cell, done)};
            if (inColumns)
                for (const Axis& axis : world) row.push_back(axis.of(cell->spec));
            table.rows.push_back(joined(std::move(row), numbersOf(done)));
        }
    }
    return table;
}

}  // namespace

std::string fourDigits(double value) {
    if (!std::isfinite(value)) return "";
    const double size = std::abs(value);
    return fmt::format("{:.{}f}", value, size < 9.9995 ? 3 : size < 99.995 ? 2 : size < 999.95 ? 1 : 0);
}

TextRows tabulate(const Suite& suite, const results::StoredRuns& runs) {
    return tabulateRuns(suite, runs, timesHeader(suite.baseline),
                        [&](const auto& done) { return timesOf(done, suite.baseline); });
}

TextRows tabulate(const std::vector<MeasuredCell>& cells) {
    const bool withOwn = std::ranges::any_of(
        cells, [](const MeasuredCell& cell) { return !numbersIn(cell.done, "method_ms_median").empty(); });
    TextRows table{joined({"method", "runs"}, timesHeader(withOwn)), {}};
    for (const MeasuredCell& cell : cells)
        table.rows.push_back(joined({cell.label + invalidMark(cell.done), std::to_string(cell.done.size())},
                                    timesOf(cell.done, withOwn)));
    return table;
}

bool isTimed(const Suite& suite, const results::StoredRuns& runs) {
    bool anyDone = false;
    for (const PlannedRun& cell : suite.cells) {
        const auto done = doneRuns(cell, suite.repetitions, runs);
        anyDone = anyDone || !done.empty();
        if (!numbersIn(done, "fps_avg").empty()) return true;
    }
    return !anyDone;
}

TextRows tabulateCounts(const Suite& suite, const results::StoredRuns& runs) {
    Row columns{"particles_median", "primitives_median", "cpu_bytes", "gpu_bytes"};
    if (const std::string& quantity = suite.chart.column;
        !quantity.empty() && std::ranges::find(columns, quantity) == columns.end())
        columns.insert(columns.begin(), quantity);
    return tabulateRuns(suite, runs, columns, [&](const std::vector<const results::StoredRun*>& done) {
        Row row;
        for (const std::string& column : columns)
            row.push_back(threeDigitsIfSmall(measure::median(numbersIn(done, column))));
        return row;
    });
}

TextRows tabulateMetrics(const Suite& suite, const results::StoredRuns& runs) {
    const bool evaluated = std::ranges::any_of(suite.cells, [&](const PlannedRun& cell) {
        const results::StoredRun* first = doneRun(cell, 1, runs);
        return first && numberIn(*first, "rmse_linear");
    });
    if (!evaluated) return {};
    Row names;
    for (const measure::Metric& metric : measure::metrics()) names.emplace_back(metric.column);
    return tabulateRuns(suite, runs, names, metricsOf);
}

}  // namespace dustbench::suite
