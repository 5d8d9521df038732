#include "bench/claims/printed_numbers.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>

#include "bench/claims/claim_ledger.h"
#include "bench/claims/result_rows.h"
#include "bench/measure/statistics.h"
#include "bench/suite/paper.h"

namespace dustbench::bench {
namespace {

/// The sum of the columns of a run; empty if one of them is empty.
std::optional<double> sumOf(const ResultRows& rows, std::size_t row, const std::string& columns) {
    double sum = 0;
    std::istringstream names(columns);
    for (std::string name; names >> name;) {
        const auto value = rows.number(row, name);
        if (!value) return std::nullopt;
        sum += *value;
    }
    return sum;
}

}  // namespace

TextRows tabulatePrinted(const files::CsvTable& published, const files::CsvTable& summary) {
    TextRows table{{"what", "paper", "formula", "measured", "measured/formula"}, {}};
    for (std::size_t line = 0; line < published.rows(); ++line) {
        const std::string where = published.where(line);
        const std::string& columns = published.cell(line, "columns");
        const Selection of = parseSelection(published.cell(line, "of"), where + "of");
        std::istringstream names(columns);
        for (std::string name; names >> name;) requireColumn(where, name);
        const std::string& suite = published.cell(line, "suite");
        std::set<std::string> runs;
        if (!suite.empty()) runs = runIdsOf(suite, summary);
        const ResultRows rows(summary, suite.empty() ? nullptr : &runs);
        std::vector<double> sums;
        for (const std::size_t row : rows.select(of))
            if (const auto sum = sumOf(rows, row, columns)) sums.push_back(*sum);
        const std::string& formula = published.cell(line, "formula");
        std::string measured, ratio;
        if (!sums.empty()) {
            const double found = median(sums);
            measured = found == std::floor(found) ? files::csvNumber(found) : fmt::format("{:.4g}", found);
            if (!formula.empty()) ratio = fmt::format("{:.3f}", found / published.number(line, "formula"));
        }
        table.rows.push_back(
            {published.cell(line, "what"), published.cell(line, "published"), formula, measured, ratio});
    }
    return table;
}

TextRows tabulatePrinted(const std::string& paper, const files::CsvTable& summary) {
    const std::filesystem::path file = paperFile(paper, "numbers.csv");
    if (file.empty()) return {};
    return tabulatePrinted(files::CsvTable::parseFile(file), summary);
}

}  // namespace dustbench::bench
