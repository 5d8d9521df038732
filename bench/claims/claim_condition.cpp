// The words that say in which cells a claim is true.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/claims/claim_verdict.h"

namespace dustbench::bench {
namespace {

using files::numberOf;

/// The values that a column has in the true cells, and in the false ones.
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

/// `true for speed up to 10, false from 20`, if one column tells true cells from false ones; else empty.
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

/// Names the true cells or the false ones, whichever are fewer, if they fit in a line.
std::string listed(const std::vector<ClaimCell>& cells) {
    constexpr std::size_t maximumListed = 3;
    std::vector<std::string> holding, failing;
    for (const ClaimCell& cell : cells) {
        if (cell.verdict == ClaimVerdict::confirmed) holding.push_back(textOf(cell.cell));
        if (cell.verdict == ClaimVerdict::refuted) failing.push_back(textOf(cell.cell));
    }
    const bool fewFail = failing.size() <= holding.size();
    const std::vector<std::string>& fewer = fewFail ? failing : holding;
    std::string text = fmt::format("true in {} of {} cells", holding.size(), cells.size());
    if (fewer.size() <= maximumListed)
        text += fmt::format(": {} {}", fewFail ? "false with" : "only with", fmt::join(fewer, "; "));
    return text;
}

}  // namespace

std::string conditionOf(const std::vector<ClaimCell>& cells) {
    for (const std::string& column : columnsOf(cells))
        if (std::string text = separationBy(column, sidesOf(cells, column)); !text.empty()) return text;
    return listed(cells);
}

}  // namespace dustbench::bench
