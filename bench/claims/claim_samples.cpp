#include "bench/claims/claim_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <stdexcept>

#include "bench/measure/cost_fit.h"

namespace dustbench::claims {
namespace {

constexpr std::array<std::string_view, 10> cellColumns{"method", "scene", "drive",   "seed",   "width",
                                                       "height", "sync",  "threads", "frames", "dust_on"};

using files::numberOf;

bool sameValue(const std::string& a, const std::string& b) {
    if (a == b) return true;
    const auto x = numberOf(a), y = numberOf(b);
    return x && y && *x == *y;
}

/// Columns that do not distinguish cells: the seed if it is the turn, and the load of a curve.
std::set<std::string> columnsWithin(const Rule& rule) {
    std::set<std::string> columns;
    if (rule.over == Chance::seeds) columns.insert("seed");
    if (!rule.against.empty() && rule.quantity != Quantity::matched) columns.insert(rule.against);
    return columns;
}

/// Replaces the depth by the edge of the finest voxels.
void replaceDepthByEdge(Selection& cell, const std::string& worldEdge) {
    const auto depth = std::ranges::find(cell, "p.depth", &Selection::value_type::first);
    if (depth == cell.end()) return;
    const auto world = files::numberOf(worldEdge), levels = files::numberOf(depth->second);
    if (world && levels) *depth = {std::string(voxelEdgeColumn), fmt::format("{:g}", *world / std::exp2(*levels))};
}

template <typename Value>
std::vector<Cell> cellsOf(const std::map<Cell, Value>& map) {
    const auto cells = std::views::keys(map);
    return {cells.begin(), cells.end()};
}

/// Collects the values of each cell.
class SampleTable {
 public:
    SampleTable(const Rule& rule, const ResultRows& rows) : rule_(rule), rows_(rows), within_(columnsWithin(rule)) {}

    [[nodiscard]] Cell cellOf(std::size_t row) const { return rows_.cellOf(row, within_); }
    [[nodiscard]] Cell cellOf(std::size_t row, std::size_t second) const {
        return {cellOf(row).values, cellOf(second).values};
    }
    [[nodiscard]] std::int64_t turnOf(std::size_t row) const {
        if (rule_.over != Chance::seeds) return rows_.repetition(row);
        return static_cast<std::int64_t>(std::clamp(rows_.number(row, "seed").value_or(1), 0.0, 9e18));
    }
    void add(const Cell& cell, std::int64_t turn, double numerator, double denominator = 1) {
        values_[cell][turn].push_back({numerator, denominator});
    }
    [[nodiscard]] bool empty() const { return values_.empty(); }

    /// Averages the values of each cell and turn. If the quantity does not vary between repetitions, takes the first.
    void giveTo(ClaimSamples& samples) const {
        const std::vector<Cell> cells = cellsOf(values_);
        for (const auto& [cell, turns] : values_) {
            samples.cells.push_back(rows_.valuesThatDiffer(cell, cells));
            if (rule_.along == voxelEdgeColumn)
                replaceDepthByEdge(samples.cells.back(), rows_.valueIn(cell, "p.world_edge"));
            for (const auto& [turn, list] : turns) {
                const bool once = rule_.over != Chance::repetitions;
                samples.list.push_back(meanOf(once ? std::span(list).first(1) : std::span(list)));
                samples.list.back().cell = samples.cells.size() - 1;
                samples.list.back().turn = turn;
                if (rule_.over == Chance::none) break;
            }
        }
    }

 private:
    struct Fraction {
        double numerator, denominator;
    };
    static ClaimSample meanOf(std::span<const Fraction> fractions) {
        ClaimSample mean{.denominator = 0};
        const auto count = static_cast<double>(fractions.size());
        for (const auto& [numerator, denominator] : fractions) {
            mean.numerator += numerator / count;
            mean.denominator += denominator / count;
            mean.value += denominator > 0 ? numerator / denominator / count : std::numeric_limits<double>::quiet_NaN();
        }
        return mean;
    }

    const Rule& rule_;
    const ResultRows& rows_;
    std::set<std::string> within_;
    std::map<Cell, std::map<std::int64_t, std::vector<Fraction>>> values_;
};

std::optional<double> valueOf(const Rule& rule, const ResultRows& rows, std::size_t row) {
    const std::optional<double> value = rows.number(row, rule.column);
    if (rule.per.empty() || !value) return value;
    const std::optional<double> divisor = rows.number(row, rule.per);
    return divisor && *divisor != 0 ? std::optional(*value / *divisor) : std::nullopt;
}

std::string missingOf(const Rule& rule, const Selection& selection, const ResultRows& rows) {
    const std::string invalid = rows.invalidAmong(selection);
    return fmt::format("no {} of {} in a completed run of {}{}", rule.column, textOf(selection), rule.suite,
                       invalid.empty() ? "" : "; invalid: " + invalid);
}

/// The selected rows that have a value in the column.
template <typename Result>
std::vector<std::size_t> rowsWith(const Rule& rule, const Selection& selection, const ResultRows& rows,
                                  Result& result) {
    std::vector<std::size_t> chosen = rows.select(selection);
    std::erase_if(chosen, [&](std::size_t row) { return !valueOf(rule, rows, row); });
    if (chosen.empty() && result.missing.empty()) result.missing = missingOf(rule, selection, rows);
    result.rows.insert(result.rows.end(), chosen.begin(), chosen.end());
    return chosen;
}

/// Columns in which the two sides of a ratio may differ: those that a side names. If both name the same values, as in
/// `speed=5|10`, the column must be equal: 5 is paired with 5.
std::set<std::string> namedColumns(const Rule& rule) {
    std::set<std::string> named;
    for (const Selection* side : {&rule.of, &rule.with})
        for (const auto& [column, value] : *side) named.insert(column);
    for (const auto& each : rule.of)
        if (std::ranges::find(rule.with, each) != rule.with.end()) named.erase(each.first);
    return named;
}

void addRatios(const Rule& rule, const ResultRows& rows, SampleTable& table, ClaimSamples& samples) {
    const auto of = rowsWith(rule, rule.of, rows, samples), with = rowsWith(rule, rule.with, rows, samples);
    const std::set<std::string> named = namedColumns(rule);
    for (const std::size_t a : of)
        for (const std::size_t b : with) {
            if (!rows.correspond(a, b, named)) continue;
            const double x = *valueOf(rule, rows, a), y = *valueOf(rule, rows, b);
            if (x == 0 && y == 0)
                ++samples.undefined;
            else
                table.add(table.cellOf(a, b), table.turnOf(a), x, y);
        }
    if (table.empty() && samples.missing.empty())
        samples.missing = fmt::format("no run of {} matches a run of {} with a {} above 0", textOf(rule.of),
                                      textOf(rule.with), rule.column);
}

/// A point of the other side's curve: load, the column to match, and the rule's column.
struct MatchPoint {
    double load, match, value;
};

/// The value where the curve first reaches `match`, linear in `match` and in the value's logarithm between two loads.
std::optional<double> valueAtMatch(std::vector<MatchPoint> curve, double match) {
    std::ranges::sort(curve, {}, &MatchPoint::load);
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const MatchPoint &a = curve[i - 1], &b = curve[i];
        if ((a.match - match) * (b.match - match) > 0 || !(a.value > 0 && b.value > 0)) continue;
        const double share = a.match == b.match ? 0 : (match - a.match) / (b.match - a.match);
        return a.value * std::pow(b.value / a.value, share);
    }
    return std::nullopt;
}

void addMatched(const Rule& rule, const ResultRows& rows, SampleTable& table, ClaimSamples& samples) {
    const auto of = rowsWith(rule, rule.of, rows, samples), with = rowsWith(rule, rule.with, rows, samples);
    std::set<std::string> named = namedColumns(rule);
    named.insert(rule.against);
    for (const std::size_t a : of) {
        const std::optional<double> match = rows.number(a, rule.match);
        std::vector<MatchPoint> curve;
        for (const std::size_t b : with) {
            const auto load = rows.number(b, rule.against), other = rows.number(b, rule.match);
            if (load && other && rows.correspond(a, b, named))
                curve.push_back({*load, *other, *valueOf(rule, rows, b)});
        }
        if (!match || *match == 0) continue;  // at 0 any sufficient load matches
        if (const auto value = valueAtMatch(std::move(curve), *match))
            table.add(table.cellOf(a), table.turnOf(a), *valueOf(rule, rows, a) / *value);
        else
            ++samples.unmatched;
    }
    if (table.empty() && samples.missing.empty())
        samples.missing =
            fmt::format("no {} above 0 that both {} and {} reach", rule.match, textOf(rule.of), textOf(rule.with));
}

void addShares(const Rule& rule, const ResultRows& rows, SampleTable& table, ClaimSamples& samples) {
    for (const std::size_t row : rowsWith(rule, rule.of, rows, samples)) {
        double sum = 0;
        for (const std::string& part : rule.parts) sum += rows.number(row, part).value_or(0);
        if (const double whole = *valueOf(rule, rows, row); whole != 0)
            table.add(table.cellOf(row), table.turnOf(row), sum, whole);
    }
}

void addValues(const Rule& rule, const ResultRows& rows, SampleTable& table, ClaimSamples& samples) {
    for (const std::size_t row : rowsWith(rule, rule.of, rows, samples))
        table.add(table.cellOf(row), table.turnOf(row), *valueOf(rule, rows, row));
}

/// Points of the curves, one curve for each cell and turn.
using Curves = std::map<std::pair<Cell, std::int64_t>, std::vector<measure::CostPoint>>;

Curves curvesOf(const Rule& rule, const ResultRows& rows, const SampleTable& table, ClaimSamples& samples) {
    Curves curves;
    for (const std::size_t row : rowsWith(rule, rule.of, rows, samples))
        if (const auto load = rows.number(row, rule.against))
            curves[{table.cellOf(row), table.turnOf(row)}].push_back({*load, *valueOf(rule, rows, row)});
    return curves;
}

/// (y₂ − y₁)/(x₂ − x₁) over (y₁ − y₀)/(x₁ − x₀), with x₁ the load nearest to the middle of the range.
std::optional<double> ratioOfSlopes(const std::vector<measure::CostPoint>& points) {
    const auto [first, last] = std::ranges::minmax_element(points, {}, &measure::CostPoint::load);
    const double half = (first->load + last->load) / 2;
    const auto middle = std::ranges::min_element(
        points, {}, [&](const measure::CostPoint& point) { return std::abs(point.load - half); });
    if (middle == first || middle == last || middle->ms == first->ms) return std::nullopt;
    return (last->ms - middle->ms) / (last->load - middle->load) /
           ((middle->ms - first->ms) / (middle->load - first->load));
}

/// The value at the maximum load over that at the minimum, Kendall's rank correlation, or the ratio of slopes.
void addCurves(const Rule& rule, const ResultRows& rows, SampleTable& table, ClaimSamples& samples) {
    for (auto& [where, points] : curvesOf(rule, rows, table, samples)) {
        const auto [first, last] = std::ranges::minmax_element(points, {}, &measure::CostPoint::load);
        if (first->load == last->load) continue;
        if (rule.quantity == Quantity::trend)
            table.add(where.first, where.second, measure::rankCorrelation(points));
        else if (rule.quantity == Quantity::slopes) {
            if (const auto ratio = ratioOfSlopes(points)) table.add(where.first, where.second, *ratio);
        } else if (first->ms == 0 && last->ms == 0)
            ++samples.undefined;
        else
            table.add(where.first, where.second, last->ms, first->ms);
    }
    if (table.empty() && samples.missing.empty())
        samples.missing = fmt::format("{} does not vary in the runs of {}", rule.against, textOf(rule.of));
}

void makeSortedUnique(std::vector<std::size_t>& rows) {
    std::ranges::sort(rows);
    const auto repeated = std::ranges::unique(rows);
    rows.erase(repeated.begin(), repeated.end());
}

}  // namespace

ResultRows::ResultRows(const files::CsvTable& table, const std::set<std::string>* runIds) : table_(table) {
    const bool evaluatesValidity = table.hasColumn("invalid");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (table.cell(row, "status") != "done" || (runIds && !runIds->contains(table.cell(row, "run_id")))) continue;
        (evaluatesValidity && !table.cell(row, "invalid").empty() ? invalid_ : rows_).push_back(row);
    }
    for (const std::string& column : table.header())
        if (column.starts_with("p.") || std::ranges::find(cellColumns, column) != cellColumns.end())
            identity_.push_back(column);
}

bool ResultRows::matches(std::size_t row, const Selection& selection) const {
    return std::ranges::all_of(selection, [&](const auto& cell) {
        if (!table_.hasColumn(cell.first)) return false;
        return std::ranges::any_of(alternativesIn(cell.second), [&](const std::string& choice) {
            return sameValue(table_.cell(row, cell.first), choice);
        });
    });
}

std::vector<std::size_t> ResultRows::select(const Selection& selection) const {
    std::vector<std::size_t> chosen;
    std::ranges::copy_if(rows_, std::back_inserter(chosen), [&](std::size_t row) { return matches(row, selection); });
    return chosen;
}

std::string ResultRows::invalidAmong(const Selection& selection) const {
    std::map<std::string, int> counts;
    for (const std::size_t row : invalid_)
        if (matches(row, selection)) ++counts[table_.cell(row, "invalid")];
    std::string text;
    for (const auto& [reason, count] : counts)
        text += fmt::format("{}{} ({} run{})", text.empty() ? "" : "; ", reason, count, count == 1 ? "" : "s");
    return text;
}

std::optional<double> ResultRows::number(std::size_t row, std::string_view column) const {
    return table_.hasColumn(column) ? numberOf(table_.cell(row, column)) : std::nullopt;
}

int ResultRows::repetition(std::size_t row) const {
    return static_cast<int>(std::clamp(number(row, "repetition").value_or(1), 0.0, 1e9));
}

const std::string& ResultRows::runId(std::size_t row) const {
    return table_.cell(row, "run_id");
}

bool ResultRows::correspond(std::size_t a, std::size_t b, const std::set<std::string>& named) const {
    if (repetition(a) != repetition(b)) return false;
    return std::ranges::all_of(identity_, [&](const std::string& column) {
        if (named.contains(column)) return true;
        const std::string &x = table_.cell(a, column), &y = table_.cell(b, column);
        return x == y || x.empty() || y.empty();
    });
}

Cell ResultRows::cellOf(std::size_t row, const std::set<std::string>& except) const {
    Cell cell;
    for (const std::string& column : identity_)
        cell.values.push_back(except.contains(column) ? "" : table_.cell(row, column));
    return cell;
}

std::string ResultRows::valueIn(const Cell& cell, std::string_view column) const {
    const auto found = std::ranges::find(identity_, column);
    return found == identity_.end() ? "" : cell.values[static_cast<std::size_t>(found - identity_.begin())];
}

Selection ResultRows::valuesThatDiffer(const Cell& cell, const std::vector<Cell>& cells) const {
    const auto differs = [&](auto values, std::size_t column) {
        return std::ranges::any_of(cells, [&](const Cell& other) {
            return column < (other.*values).size() && (other.*values)[column] != (cell.*values)[column];
        });
    };
    Selection chosen;
    for (std::size_t c = 0; c < cell.values.size(); ++c)
        if (!cell.values[c].empty() && differs(&Cell::values, c)) chosen.emplace_back(identity_[c], cell.values[c]);
    for (std::size_t c = 0; c < cell.second.size(); ++c) {
        const std::string &value = cell.second[c], &column = identity_[c];
        if (value.empty() || value == cell.values[c] || !differs(&Cell::second, c)) continue;
        chosen.emplace_back("with " + (column.starts_with("p.") ? column.substr(2) : column), value);
    }
    return chosen;
}

ClaimSamples samplesOf(const Rule& rule, const ResultRows& rows) {
    ClaimSamples samples;
    SampleTable table(rule, rows);
    switch (rule.quantity) {
        case Quantity::ratio:
            addRatios(rule, rows, table, samples);
            break;
        case Quantity::matched:
            addMatched(rule, rows, table, samples);
            break;
        case Quantity::share:
            addShares(rule, rows, table, samples);
            break;
        case Quantity::value:
            addValues(rule, rows, table, samples);
            break;
        case Quantity::growth:
        case Quantity::trend:
        case Quantity::slopes:
            addCurves(rule, rows, table, samples);
            break;
        case Quantity::exponent:
        case Quantity::finding:
        case Quantity::none:
            throw std::invalid_argument("samplesOf: the quantity has no samples in a summary");
    }
    if (table.empty() && samples.missing.empty()) samples.missing = "no " + rule.column + " that is not 0";
    table.giveTo(samples);
    makeSortedUnique(samples.rows);
    return samples;
}

CostCurves costCurvesOf(const Rule& rule, const ResultRows& rows) {
    CostCurves result;
    std::map<Cell, std::vector<measure::CostPoint>> curves;
    for (const std::size_t row : rowsWith(rule, rule.of, rows, result))
        if (const auto load = rows.number(row, rule.against))
            curves[rows.cellOf(row, columnsWithin(rule))].push_back({*load, *valueOf(rule, rows, row)});
    const std::vector<Cell> cells = cellsOf(curves);
    for (const auto& [cell, points] : curves) result.curves.push_back({rows.valuesThatDiffer(cell, cells), points});
    makeSortedUnique(result.rows);
    return result;
}

}  // namespace dustbench::claims
