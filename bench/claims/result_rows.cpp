#include "bench/claims/result_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <sstream>

namespace dustbench::bench {
namespace {

constexpr std::array<std::string_view, 9> identityColumns{"method", "scene", "drive",   "seed",  "width",
                                                          "height", "sync",  "threads", "frames"};

using files::numberOf;

bool sameValue(const std::string& a, const std::string& b) {
    if (a == b) return true;
    const auto x = numberOf(a), y = numberOf(b);
    return x && y && *x == *y;
}

}  // namespace

ResultRows::ResultRows(const files::CsvTable& table, const std::set<std::string>* runIds) : table_(table) {
    const bool evaluatesValidity = table.hasColumn("invalid");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (table.cell(row, "status") != "done" || (runIds && !runIds->contains(table.cell(row, "run_id")))) continue;
        (evaluatesValidity && !table.cell(row, "invalid").empty() ? invalid_ : rows_).push_back(row);
    }
    for (const std::string& column : table.header())
        if (column.starts_with("p.") || std::ranges::find(identityColumns, column) != identityColumns.end())
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

std::string ResultRows::cellKey(std::size_t row, const std::set<std::string>& except) const {
    std::string key;
    for (const std::string& column : identity_)
        key.append(except.contains(column) ? "" : table_.cell(row, column)).append(1, '\n');
    return key;
}

std::string ResultRows::valueIn(const std::string& key, std::string_view column) const {
    std::istringstream values(key);
    std::string value;
    for (const std::string& each : identity_) {
        std::getline(values, value);
        if (each == column) return value;
    }
    return {};
}

Selection ResultRows::cellValues(const std::string& key, const std::vector<std::string>& keys) const {
    std::vector<std::istringstream> others(keys.begin(), keys.end());
    std::istringstream own(key);
    Selection values;
    std::map<std::string, std::string> first;
    for (bool isSecond = false; own.peek() != std::istringstream::traits_type::eof(); isSecond = true)
        for (const std::string& column : identity_) {
            std::string value, other;
            std::getline(own, value);
            bool differs = false;
            for (std::istringstream& stream : others) differs |= std::getline(stream, other) && other != value;
            if (!isSecond) first[column] = value;
            if (!differs || value.empty()) continue;
            if (!isSecond)
                values.emplace_back(column, value);
            else if (first[column] != value)
                values.emplace_back("with " + (column.starts_with("p.") ? column.substr(2) : column), value);
        }
    return values;
}

}  // namespace dustbench::bench
