#include "bench/cli/regression_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <sstream>

#include "bench/cli/exit_codes.h"
#include "bench/cli/text_table.h"
#include "bench/export/whole_file.h"
#include "bench/results/stored_folder.h"
#include "bench/suite/planned_evaluation.h"
#include "bench/suite/regression/regression_table.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

std::vector<std::string> parseColumns(const std::string& text) {
    if (text.empty()) return {"frame_ms_median"};
    const std::vector<std::string> known = bench::comparableColumns();
    std::vector<std::string> columns;
    std::istringstream words(text + ",");
    for (std::string word; std::getline(words, word, ',');) {
        if (std::ranges::find(known, word) == known.end()) throw unknownName("column to compare", word, known);
        if (std::ranges::find(columns, word) != columns.end())
            throw InputError(fmt::format("--columns: got '{}' twice", word));
        columns.push_back(word);
    }
    return columns;
}

void writeCsv(const std::string& folder, const std::string& text) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) files::failWriting(folder, error.value());
    const std::filesystem::path file = std::filesystem::path(folder) / "comparison.csv";
    bench::writeWhole(file, text);
    std::cout << file.string() << "\n";
}

/// Reports what is slower by more than `percent`; true if anything is, or newly fails.
bool sayRegressions(const bench::FolderComparison& comparison, double percent) {
    std::size_t slower = 0;
    for (const bench::JudgedCell& judged : comparison.judged) {
        if (!bench::isSlowerBy(judged, percent)) continue;
        ++slower;
        std::cerr << fmt::format("regression: {}: {} takes {:.4g} [{:.4g}, {:.4g}] times as long in B\n", judged.column,
                                 judged.cell ? labelOf(*judged.cell, comparison.axes) : "all cells together",
                                 judged.result.ratio, judged.result.low, judged.result.high);
    }
    for (const bench::FolderCell* cell : comparison.broken)
        std::cerr << fmt::format("regression: {}: {} in B: {}\n", labelOf(*cell, comparison.axes),
                                 cell->b.failed.front()->status == bench::RunStatus::timeout ? "timed out" : "failed",
                                 cell->b.failed.front()->reason);
    return slower > 0 || !comparison.broken.empty();
}

}  // namespace

int checkRegression(const RegressionOptions& options) {
    const std::vector<std::string> columns = parseColumns(options.columns);
    const bench::ResultsSide a{options.a, bench::readStoredRuns(options.a)};
    const bench::ResultsSide b{options.b, bench::readStoredRuns(options.b)};
    for (const bench::ResultsSide* side : {&a, &b})
        if (const std::string said = bench::saysNothingOfOutputs(side->runs); !said.empty())
            std::cerr << fmt::format("warning: '{}': {}\n", files::printable(side->name), said);
    const bench::FolderComparison comparison = bench::compareFolders(a, b, columns, options.acrossMachines);
    for (const std::string& remark : comparison.remarks) std::cerr << "note: " << files::printable(remark) << "\n";
    for (const std::string& obstacle : comparison.obstacles)
        std::cerr << "not comparable: " << files::printable(obstacle) << "\n";
    if (!comparison.obstacles.empty()) return exitNotComparable;

    std::cout << fmt::format(
        "B = {} against A = {}: ratio of their times, 95 % interval over runs that were not measured by turns\n",
        options.b, options.a);
    bench::TextRows table = bench::tabulate(comparison);
    table.rows.insert(table.rows.begin(), std::move(table.header));
    std::cout << textTable(table.rows);
    if (!options.out.empty()) writeCsv(options.out, bench::comparisonCsv(comparison, options.failPercent));
    if (!options.failPercent) return exitOk;

    if (sayRegressions(comparison, *options.failPercent)) return exitRegression;
    // A check that cannot fail must not look as if it passed.
    if (std::ranges::none_of(comparison.judged, [](const auto& judged) { return judged.result.hasEnough(); })) {
        std::cerr << fmt::format("not comparable: no cell has {} runs with times in both, so no regression can show\n",
                                 bench::minimumTimes);
        return exitNotComparable;
    }
    return exitOk;
}

}  // namespace dustbench::cli
