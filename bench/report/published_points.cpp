#include "bench/report/published_points.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>

#include "bench/report/report_files.h"
#include "bench/results/method_facts.h"
#include "bench/results/summary.h"
#include "bench/suite/paper.h"
#include "bench/suite/suite.h"
#include "bench/suite/suite_cells.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::report {
namespace {

using files::CsvTable;
using files::numberOf;

/// A suite with all of its configurations, as the checks need it.
struct ChartOfSuite {
    suite::Suite suite;
    std::vector<suite::Axis> axes;  ///< everything that varies except seeds, which are not settings
};

class PublishedReader {
 public:
    PublishedReader(const std::string& paper, const CsvTable& table)
        : table_(table), suites_(suite::loadPaper(paper).suites) {
        if (const std::filesystem::path numbers = suite::paperFile(paper, "numbers.csv"); !numbers.empty())
            numbers_ = CsvTable::parseFile(numbers);
    }

    [[nodiscard]] PublishedPoint read(std::size_t row) {
        row_ = row;
        PublishedPoint point;
        const ChartOfSuite& chart = readChart();
        point.column = readColumn(chart);
        point.axis = cell("axis");
        if (!point.axis.empty()) point.x = readPlace(chart, point.axis);
        point.of = claims::parseSelection(cell("of"), table_.where(row) + "of");
        const std::vector<std::string> series = readSeries(chart, point);
        point.minimum = table_.number(row, "min");
        point.maximum = table_.number(row, "max");
        if (point.maximum < point.minimum) fail("max", cell("max"), cell("min") + " and above");
        point.hardware = cell("hardware");
        if (static const std::regex year("(^|[^0-9])(19|20)[0-9]{2}([^0-9]|$)");
            !std::regex_search(point.hardware, year))
            fail("hardware", point.hardware, "a machine and its year");
        point.what = cell("what");
        if (!places_
                 .insert(fmt::format("{}\n{}\n{}\n{}\n{}", chart.suite.id, fmt::join(series, "\n"), point.axis, point.x,
                                     point.column))
                 .second)
            fail("of", cell("of"), "a series without another number at this place");
        requireSameAsPrinted(point);
        return point;
    }

 private:
    [[noreturn]] void fail(std::string_view thing, std::string_view got, std::string_view allowed) const {
        throw InputError(fmt::format("{}{}: got '{}', allowed: {}", table_.where(row_), thing, got, allowed));
    }
    [[nodiscard]] const std::string& cell(std::string_view column) const { return table_.cell(row_, column); }

    const ChartOfSuite& readChart() {
        const std::string& id = cell("suite");
        if (std::ranges::find(suites_, id) == suites_.end())
            fail("suite", id, fmt::format("{}, the suites of the paper", fmt::join(suites_, ", ")));
        const auto [found, isNew] = charts_.try_emplace(id);
        ChartOfSuite& chart = found->second;
        if (isNew) {
            chart.suite = suite::loadSuite(id, false);
            const std::vector<const suite::PlannedRun*> cells = suite::cellsOf(chart.suite);
            chart.axes = suite::worldAxes(cells);
            std::ranges::move(suite::methodAxes(cells), std::back_inserter(chart.axes));
            std::erase_if(chart.axes, [](const suite::Axis& axis) { return axis.name == "seed"; });
        }
        if (chart.axes.empty() && chart.suite.cells.size() < 2)
            fail("suite", id, "a suite with a chart, which needs two configurations or more");
        return chart;
    }

    /// The column with which the chart opens, or its reciprocal: otherwise nobody would see the number.
    [[nodiscard]] std::string readColumn(const ChartOfSuite& chart) const {
        const std::string& name = cell("column");
        const bool isTimed = std::ranges::any_of(chart.suite.cells, [](const auto& run) { return run.spec.timed; });
        const std::string opens = chart.suite.chart.column.empty() ? "fps_avg" : chart.suite.chart.column;
        std::set<std::string> allowed{opens};
        if (opens == "fps_avg" || opens == "frame_ms_median") allowed = {"fps_avg", "frame_ms_median"};
        if (!isTimed) std::erase_if(allowed, [](const std::string& column) { return results::dependsOnSpeed(column); });
        if (!allowed.contains(name))
            fail("column", name, fmt::format("{}: the column of the suite's chart", fmt::join(allowed, ", ")));
        if (const std::string unit = unitOf(name); cell("unit") != unit)
            fail("unit", cell("unit"), fmt::format("{}, the unit of {}", unit, name));
        return name;
    }

    [[nodiscard]] static std::string unitOf(const std::string& column) {
        for (const results::MethodFact& fact : results::methodFacts())
            if (fact.info.name == column) return fact.info.unit;
        static const auto columns = nlohmann::json::parse(reportColumns());
        return columns.contains(column) ? columns[column].value("unit", "") : "";
    }

    [[nodiscard]] double readPlace(const ChartOfSuite& chart, const std::string& name) const {
        std::map<std::string, std::vector<double>> loads;
        for (const suite::Axis& axis : chart.axes) {
            std::vector<double> values;
            bool isNumeric = true;
            for (const suite::PlannedRun& run : chart.suite.cells) {
                const std::optional<double> value = numberOf(axis.of(run.spec));
                isNumeric = isNumeric && value;
                values.push_back(value.value_or(0));
            }
            if (isNumeric) loads[axis.name] = values;
        }
        if (const std::string& opens = chart.suite.chart.against; !opens.empty())
            std::erase_if(loads, [&opens](const auto& load) { return load.first != opens; });
        const auto found = loads.find(name);
        if (found == loads.end()) {
            std::vector<std::string> names;
            names.reserve(loads.size());
            for (const auto& [each, values] : loads) names.push_back(each);
            fail("axis", name,
                 names.empty() ? std::string("nothing: the suite has no load")
                               : fmt::format("{}: the axis of the suite's chart", fmt::join(names, ", ")));
        }
        const auto [low, high] = std::ranges::minmax(found->second);
        const double x = table_.number(row_, "x");
        if (x < low || x > high) fail("x", cell("x"), fmt::format("{} to {}, the loads of the suite", low, high));
        return x;
    }

    /// Labels of the selected series: exactly one, unless the paper states no load.
    [[nodiscard]] std::vector<std::string> readSeries(const ChartOfSuite& chart, const PublishedPoint& point) const {
        std::vector<suite::Axis> rest = chart.axes;
        std::erase_if(rest, [&point](const suite::Axis& axis) { return axis.name == point.axis; });
        std::set<std::string> all, found;
        for (const suite::PlannedRun& run : chart.suite.cells) {
            const std::string settings = suite::labelOf(rest, run.spec);
            const std::string label = run.spec.method + (settings.empty() ? "" : " " + settings);
            all.insert(label);
            if (matches(point.of, run.spec)) found.insert(label);
        }
        const std::string allowed = fmt::format("{}: a series of the chart", fmt::join(all, ", "));
        if (found.empty()) fail("of", cell("of"), allowed);
        if (found.size() > 1 && !point.axis.empty())
            fail("of", fmt::format("{} ({} series)", cell("of"), found.size()), "one of " + allowed);
        return {found.begin(), found.end()};
    }

    [[nodiscard]] static bool matches(const claims::Selection& of, const results::RunSpec& spec) {
        return std::ranges::all_of(of, [&spec](const auto& wanted) {
            const auto& [column, text] = wanted;
            if (column == "method") return spec.method == text;
            const std::string name = claims::nameOf(column);
            if (name == "scene") return spec.scene == text;
            if (name == "drive") return spec.drive == text;
            if (name == "size") return fmt::format("{}x{}", spec.size.width, spec.size.height) == text;
            const auto found = spec.parameters.find(name);
            return found != spec.parameters.end() && isSame(found->second, text);
        });
    }

    [[nodiscard]] static bool isSame(const std::string& a, const std::string& b) {
        const std::optional<double> x = numberOf(a), y = numberOf(b);
        return a == b || (x && y && *x == *y);
    }

    /// If numbers.csv contains the same quantity, its value must be the same. A text there is not a number.
    void requireSameAsPrinted(const PublishedPoint& point) const {
        if (!numbers_) return;
        claims::Selection own = point.of;
        if (!point.axis.empty()) own.emplace_back("p." + point.axis, cell("x"));
        for (std::size_t row = 0; row < numbers_->rows(); ++row) {
            const std::string& text = numbers_->cell(row, "published");
            if (text.empty() || numbers_->cell(row, "suite") != cell("suite") ||
                numbers_->cell(row, "columns") != point.column)
                continue;
            const claims::Selection other =
                claims::parseSelection(numbers_->cell(row, "of"), numbers_->where(row) + "of");
            const bool isThis = std::ranges::is_permutation(other, own, [](const auto& a, const auto& b) {
                return a.first == b.first && isSame(a.second, b.second);
            });
            const std::optional<double> printed = numberOf(text);  // none for `++: more than the screen's rate`
            if (isThis && (!printed || *printed < point.minimum || *printed > point.maximum))
                fail("min", cell("min"),
                     fmt::format("{}, which numbers.csv has for '{}'", text, numbers_->cell(row, "of")));
        }
    }

    const CsvTable& table_;
    std::size_t row_ = 0;
    std::vector<std::string> suites_;
    std::map<std::string, ChartOfSuite> charts_;
    std::set<std::string> places_;
    std::optional<CsvTable> numbers_;
};

/// A run's value of a setting that a selection names.
std::string settingOf(const results::StoredRun& run, const std::string& name) {
    if (name == "size") return run.cells.at("width") + "x" + run.cells.at("height");
    if (const auto parameter = run.parameters.find(name); parameter != run.parameters.end()) return parameter->second;
    const auto found = run.cells.find(name);
    return found == run.cells.end() ? std::string() : found->second;
}

bool isOf(const results::StoredRun& run, const claims::Selection& of) {
    return std::ranges::all_of(of, [&run](const auto& wanted) {
        const std::string value = settingOf(run, claims::nameOf(wanted.first));
        const std::optional<double> x = numberOf(value), y = numberOf(wanted.second);
        return value == wanted.second || (x && y && *x == *y);
    });
}

}  // namespace

std::map<std::string, std::vector<PublishedPoint>> readPublished(const std::string& paper) {
    const std::filesystem::path file = suite::paperFile(paper, "published.csv");
    std::map<std::string, std::vector<PublishedPoint>> bySuite;
    if (file.empty()) return bySuite;
    const auto table = CsvTable::parseFile(file);
    PublishedReader reader(paper, table);
    for (std::size_t row = 0; row < table.rows(); ++row) bySuite[table.cell(row, "suite")].push_back(reader.read(row));
    return bySuite;
}

std::vector<PublishedPoint> publishedIn(const RunGroup& group, const std::vector<PublishedPoint>& points) {
    std::vector<PublishedPoint> found;
    for (PublishedPoint point : points) {
        const auto cell = std::ranges::find_if(group.cells, [&point](const ReportCell& each) {
            return !each.done.empty() && isOf(*each.done.front(), point.of);
        });
        if (cell == group.cells.end()) continue;
        point.method = cell->method;
        for (const auto& [column, value] : point.of)
            if (const auto setting = cell->settings.find(claims::nameOf(column)); setting != cell->settings.end())
                point.settings.insert(*setting);
        found.push_back(std::move(point));
    }
    return found;
}

}  // namespace dustbench::report
