// Describes in words for which cells (configurations) a claim is true.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bench/claims/claim_verdict.h"

namespace dustbench::claims {
namespace {

using files::numberOf;

/// The values of a column in the cells where the claim is true, and where it is false.
struct Sides {
    std::set<std::string> holding, failing;
};

Sides sidesOf(const std::vector<ClaimCell>& cells, const std::string& column) {
    Sides sides;
    for (const ClaimCell& cell : cells) {
        if (cell.verdict != ClaimVerdict::confirmed && cell.verdict != ClaimVerdict::refuted) continue;
        std::set<std::string>& side = cell.verdict == ClaimVerdict::confirmed ? sides.holding : sides.failing;
        const auto value = std::ranges::find(cell.cell, column, &Selection::value_type::first);
        side.insert(value == cell.cell.end() ? "" : value->second);
    }
    return sides;
}

std::optional<std::pair<double, double>> rangeOf(const std::set<std::string>& values) {
    std::optional<std::pair<double, double>> range;
    for (const std::string& text : values) {
        const std::optional<double> value = numberOf(text);
        if (!value) return std::nullopt;
        range = range ? std::pair(std::min(range->first, *value), std::max(range->second, *value))
                      : std::pair(*value, *value);
    }
    return range;
}

/// `for speed`; the other side's columns begin with `with ` already.
std::string whereOf(const std::string& column) {
    return column.starts_with("with ") ? column : "for " + nameOf(column);
}

/// `true for speed up to 10, false from 20`, if this column separates true cells from false ones; otherwise empty.
std::string separationBy(const std::string& column, const Sides& sides) {
    const auto holding = rangeOf(sides.holding), failing = rangeOf(sides.failing);
    const std::string where = whereOf(column);
    if (holding && failing && holding->second < failing->first)
        return fmt::format("true {} up to {:g}, false from {:g}", where, holding->second, failing->first);
    if (holding && failing && failing->second < holding->first)
        return fmt::format("true {} from {:g}, false up to {:g}", where, holding->first, failing->second);
    const bool disjoint =
        std::ranges::none_of(sides.holding, [&](const std::string& value) { return sides.failing.contains(value); });
    if (!disjoint || sides.holding.contains("") || sides.failing.contains("")) return "";
    return fmt::format("true {} {}, false with {}", where, fmt::join(sides.holding, ", "),
                       fmt::join(sides.failing, ", "));
}

std::vector<std::string> columnsOf(const std::vector<ClaimCell>& cells) {
    std::vector<std::string> columns;
    for (const ClaimCell& cell : cells)
        for (const auto& [column, value] : cell.cell)
            if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
    return columns;
}

/// Lists the true or the false cells, whichever are fewer, unless there are too many.
std::string listed(const std::vector<ClaimCell>& cells) {
    constexpr std::size_t maximumListed = 3;
    std::vector<std::string> holding, failing;
    for (const ClaimCell& cell : cells) {
        if (cell.verdict == ClaimVerdict::confirmed) holding.push_back(textOf(cell.cell));
        if (cell.verdict == ClaimVerdict::refuted) failing.push_back(textOf(cell.cell));
    }
    const bool fewFail = failing.size() <= holding.size();
    const std::vector<std::string>& fewer = fewFail ? failing : holding;
    std::string text = fmt::format("true in {} of {} cases", holding.size(), cells.size());
    if (fewer.size() <= maximumListed)
        text += fmt::format(": {} {}", fewFail ? "false with" : "only with", fmt::join(fewer, "; "));
    return text;
}

/// `0.5, 2 to 8`: values that are neighbours on the axis are joined.
std::string rangesText(const std::vector<double>& values, const std::vector<double>& axis) {
    std::vector<std::string> texts;
    for (auto value = values.begin(); value != values.end();) {
        auto place = std::ranges::find(axis, *value);
        const double first = *value;
        double last = first;
        while (++value != values.end() && ++place != axis.end() && *place == *value) last = *value;
        texts.push_back(first == last ? fmt::format("{:g}", first) : fmt::format("{:g} to {:g}", first, last));
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

/// `true for 2 to 8, false for 0.5, open for 1`.
std::string rowText(const std::map<double, ClaimVerdict>& row, const std::vector<double>& axis) {
    constexpr std::array kinds{std::pair("true", ClaimVerdict::confirmed), std::pair("false", ClaimVerdict::refuted),
                               std::pair("open", ClaimVerdict::unresolved)};
    std::vector<std::string> texts;
    for (const auto& [word, verdict] : kinds) {
        std::vector<double> values;
        for (const auto& [value, found] : row)
            if (found == verdict) values.push_back(value);
        if (!values.empty()) texts.push_back(fmt::format("{} for {}", word, rangesText(values, axis)));
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

/// The verdicts along `column` for each combination of the other columns. Combinations with the same verdicts are
/// joined. Empty if a cell has no number in `column`.
std::string mapAlong(const std::vector<ClaimCell>& cells, const std::string& column) {
    std::map<std::string, std::map<double, ClaimVerdict>> rows;
    std::vector<std::string> order;  // of the rows
    std::set<double> values;
    for (const ClaimCell& cell : cells) {
        Selection others = cell.cell;
        const auto place = std::ranges::find(others, column, &Selection::value_type::first);
        if (place == others.end()) return "";
        const std::optional<double> value = numberOf(place->second);
        if (!value) return "";
        others.erase(place);
        const std::string where = textOf(others);
        if (!rows.contains(where)) order.push_back(where);
        rows[where][*value] = cell.verdict;
        values.insert(*value);
    }
    const std::vector<double> axis(values.begin(), values.end());
    std::vector<std::pair<std::string, std::vector<std::string>>> lines;  // verdict, and where it holds
    for (const std::string& where : order) {
        const std::string text = rowText(rows[where], axis);
        const auto alike = std::ranges::find(lines, text, &decltype(lines)::value_type::first);
        if (alike == lines.end())
            lines.push_back({text, {where}});
        else
            alike->second.push_back(where);
    }
    std::vector<std::string> texts;
    texts.reserve(lines.size());
    for (const auto& [text, places] : lines)
        texts.push_back(places.front().empty() ? text : fmt::format("{} ({})", text, fmt::join(places, ", ")));
    return fmt::format("by {}: {}", nameOf(column), fmt::join(texts, "; "));
}

/// The values of the column at which the claim is true in all cells, and those at which it is true in some.
std::array<std::vector<double>, 2> trueValues(const std::map<double, std::vector<ClaimVerdict>>& verdicts) {
    std::array<std::vector<double>, 2> values;
    for (const auto& [value, list] : verdicts) {
        const auto confirmed = std::ranges::count(list, ClaimVerdict::confirmed);
        if (confirmed > 0) values[std::cmp_equal(confirmed, list.size()) ? 0 : 1].push_back(value);
    }
    return values;
}

}  // namespace

std::string intervalAlong(const std::vector<ClaimCell>& cells, const std::string& column) {
    std::map<double, std::vector<ClaimVerdict>> verdicts;
    std::vector<double> axis;
    for (const ClaimCell& cell : cells) {
        const auto place = std::ranges::find(cell.cell, column, &Selection::value_type::first);
        const std::optional<double> value = place == cell.cell.end() ? std::nullopt : numberOf(place->second);
        if (!value) return "";
        verdicts[*value].push_back(cell.verdict);
    }
    std::ranges::copy(std::views::keys(verdicts), std::back_inserter(axis));
    const std::string unit = column == voxelEdgeColumn ? " m" : "";
    const auto [all, some] = trueValues(verdicts);
    std::string text = fmt::format("true for {} {}{}", nameOf(column), rangesText(all, axis), unit);
    if (all.empty()) text = fmt::format("true for no {} in every configuration", nameOf(column));
    if (!some.empty()) text += fmt::format(", in some configurations for {}{}", rangesText(some, axis), unit);
    return text;
}

std::string conditionOf(const std::vector<ClaimCell>& cells, const std::string& along) {
    if (!along.empty())
        if (std::string text = mapAlong(cells, along); !text.empty()) return text;
    for (const std::string& column : columnsOf(cells))
        if (std::string text = separationBy(column, sidesOf(cells, column)); !text.empty()) return text;
    return listed(cells);
}

}  // namespace dustbench::claims
