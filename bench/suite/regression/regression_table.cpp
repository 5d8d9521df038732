#include "bench/suite/regression/regression_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "methods/kit/files/csv.h"

namespace dustbench::suite {
namespace {

std::string verdictText(const EvaluatedCell& evaluated) {
    return std::string(measure::verdictName(evaluated.result.verdict)) +
           (evaluated.reason.empty() ? "" : ": " + evaluated.reason);
}

std::string withoutPrefix(const std::string& name) {
    return name.starts_with("p.") ? name.substr(2) : name;
}

/// All field names, in order of first appearance; then the parameters, sorted.
std::vector<std::string> identityColumns(const std::vector<FolderCell>& cells) {
    std::vector<std::string> names, parameters;
    for (const FolderCell& cell : cells)
        for (const auto& [name, value] : cell.identity) {
            std::vector<std::string>& list = name.starts_with("p.") ? parameters : names;
            if (std::ranges::find(list, name) == list.end()) list.push_back(name);
        }
    std::ranges::sort(parameters);
    names.insert(names.end(), parameters.begin(), parameters.end());
    return names;
}

}  // namespace

TextRows tabulate(const FolderComparison& comparison) {
    TextRows table;
    table.header = {"column", "method"};
    for (const std::string& axis : comparison.axes) table.header.push_back(withoutPrefix(axis));
    for (const char* name : {"A ms", "B ms", "ratio", "low", "high", "A runs", "B runs", "verdict"})
        table.header.emplace_back(name);
    for (const EvaluatedCell& evaluated : comparison.evaluated) {
        std::vector<std::string> row{evaluated.column + (evaluated.cell ? "" : ", all"),
                                     evaluated.cell ? evaluated.cell->valueOf("method") : ""};
        for (const std::string& axis : comparison.axes)
            row.push_back(evaluated.cell ? evaluated.cell->valueOf(axis) : "");
        for (const double value :
             {evaluated.aMs, evaluated.bMs, evaluated.result.ratio, evaluated.result.low, evaluated.result.high})
            row.push_back(fourDigits(value));
        row.push_back(fmt::format("{}", evaluated.result.withCount));
        row.push_back(fmt::format("{}", evaluated.result.ofCount));
        row.push_back(verdictText(evaluated));
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::vector<std::string> comparisonColumnsBefore() {
    return {"column", "all_cells"};
}

std::vector<std::string> comparisonColumnsAfter() {
    return {"a_ms",   "b_ms",     "ratio",    "low",     "high",   "runs_a",
            "runs_b", "failed_a", "failed_b", "verdict", "reason", "regression"};
}

std::string comparisonCsv(const FolderComparison& comparison, std::optional<double> percent) {
    const std::vector<std::string> identity = identityColumns(comparison.cells);
    std::string text;
    const auto addRow = [&text](const std::vector<std::string>& cells) {
        for (const std::string& cell : cells) text.append(files::csvCell(cell)).append(1, ',');
        text.back() = '\n';
    };
    std::vector<std::string> header = comparisonColumnsBefore();
    header.insert(header.end(), identity.begin(), identity.end());
    for (const std::string& name : comparisonColumnsAfter()) header.push_back(name);
    addRow(header);

    const auto identityCells = [&](const FolderCell* cell, std::vector<std::string>& row) {
        for (const std::string& name : identity) row.push_back(cell ? cell->valueOf(name) : "");
    };
    for (const EvaluatedCell& evaluated : comparison.evaluated) {
        std::vector<std::string> row{evaluated.column, evaluated.cell ? "0" : "1"};
        identityCells(evaluated.cell, row);
        const measure::UnpairedRatio& result = evaluated.result;
        for (const double value : {evaluated.aMs, evaluated.bMs, result.ratio, result.low, result.high})
            row.push_back(files::csvNumber(value));
        for (const std::size_t count : {result.withCount, result.ofCount}) row.push_back(fmt::format("{}", count));
        for (const auto side : {&FolderCell::a, &FolderCell::b})
            row.push_back(evaluated.cell ? fmt::format("{}", (evaluated.cell->*side).failed.size()) : "");
        row.emplace_back(measure::verdictName(result.verdict));
        row.push_back(evaluated.reason);
        row.emplace_back(percent ? (isSlowerBy(evaluated, *percent) ? "1" : "0") : "");
        addRow(row);
    }
    for (const FolderCell& cell : comparison.cells) {
        if (!cell.a.done.empty() && !cell.b.done.empty()) continue;
        std::vector<std::string> row{"", "0"};
        identityCells(&cell, row);
        row.resize(row.size() + 5);
        for (const auto side : {&FolderCell::a, &FolderCell::b})
            row.push_back(fmt::format("{}", (cell.*side).done.size()));
        for (const auto side : {&FolderCell::a, &FolderCell::b})
            row.push_back(fmt::format("{}", (cell.*side).failed.size()));
        row.emplace_back("");
        const bool isInvalid = !cell.a.invalid.empty() || !cell.b.invalid.empty();
        row.push_back(fmt::format("not {} in {}", isInvalid ? "valid" : "done",
                                  cell.a.done.empty() ? (cell.b.done.empty() ? "either" : "A") : "B"));
        const bool broken = std::ranges::find(comparison.broken, &cell) != comparison.broken.end();
        row.emplace_back(percent ? (broken ? "1" : "0") : "");
        addRow(row);
    }
    return text;
}

std::string comparisonMarkdown(const FolderComparison& comparison, std::string_view a, std::string_view b,
                               const std::function<bool(const EvaluatedCell&)>& isRegression) {
    TextRows all = tabulate(comparison);
    const auto row = [](const std::vector<std::string>& cells) {
        std::string text = "|";
        for (const std::string& cell : cells) {
            text += ' ';
            for (const char letter : cell) text += letter == '|' ? "\\|" : std::string(1, letter);
            text += " |";
        }
        return text + "\n";
    };
    const std::string head = row(all.header) + row(std::vector<std::string>(all.header.size(), "---"));
    std::string rows, slower;
    std::size_t count = 0;
    for (std::size_t i = 0; i < comparison.evaluated.size(); ++i) {
        rows += row(all.rows[i]);
        if (!isRegression(comparison.evaluated[i])) continue;
        slower += row(all.rows[i]);
        ++count;
    }
    std::string text = fmt::format(
        "**{} of {} comparisons are slower.** B is `{}`, A is `{}`; ratios of their times with "
        "95 % intervals.\n",
        count, comparison.evaluated.size(), b, a);
    if (count > 0) text += "\n" + head + slower;
    for (const FolderCell* cell : comparison.broken)
        text += fmt::format("\n- {}: in B {}\n", labelOf(*cell, comparison.axes), whyBroken(*cell));
    return text + fmt::format("\n<details><summary>All {} comparisons</summary>\n\n", comparison.evaluated.size()) +
           head + rows + "\n</details>\n";
}

}  // namespace dustbench::suite
