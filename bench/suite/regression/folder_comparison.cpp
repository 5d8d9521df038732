#include "bench/suite/regression/folder_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "bench/suite/planned_evaluation.h"
#include "bench/suite/regression/folder_remarks.h"

namespace dustbench::bench {
namespace {

/// ln of the time in ms; empty without a time above 0.
std::optional<double> logMs(const StoredRun& run, const std::string& column) {
    const auto number = numberIn(run, column);
    if (!number || !(*number > 0) || !std::isfinite(*number)) return std::nullopt;
    return isRate(column) ? std::log(1000.0) - std::log(*number) : std::log(*number);
}

std::vector<double> logsMs(const CellRuns& runs, const std::string& column) {
    std::vector<double> logs;
    for (const StoredRun* run : runs.done)
        if (const auto x = logMs(*run, column)) logs.push_back(*x);
    return logs;
}

double geometricMean(const std::vector<double>& logs) {
    double sum = 0;
    for (const double x : logs) sum += x;
    return std::exp(sum / static_cast<double>(logs.size()));  // NaN for none
}

EvaluatedCell evaluate(const FolderCell* cell, const std::string& column, const std::vector<double>& a,
                       const std::vector<double>& b) {
    EvaluatedCell evaluated{cell, column, geometricMean(a), geometricMean(b), compareUnpairedLogs(b, a), ""};
    if (a.empty() || b.empty())
        evaluated.reason = fmt::format("no time above 0 in {}", a.empty() ? "A" : "B");
    else if (!evaluated.result.hasEnough())
        evaluated.reason = fmt::format("{} and {} {}, {} of each are needed", a.size(), b.size(),
                                       cell ? "runs" : "complete repetitions", minimumTimes);
    return evaluated;
}

/// One number per repetition: the mean over the configurations, if all have a value.
std::vector<double> meansOverCells(const std::vector<const FolderCell*>& cells, const CellRuns FolderCell::*side,
                                   const std::string& column) {
    std::map<std::string, std::pair<double, std::size_t>> sums;  // by repetition
    for (const FolderCell* cell : cells)
        for (const StoredRun* run : (cell->*side).done)
            if (const auto x = logMs(*run, column)) {
                auto& [sum, count] = sums[run->cells.at("repetition")];
                sum += *x;
                ++count;
            }
    std::vector<double> means;
    for (const auto& [repetition, entry] : sums)
        if (entry.second == cells.size()) means.push_back(entry.first / static_cast<double>(entry.second));
    return means;
}

void evaluateColumn(const std::vector<FolderCell>& cells, const std::string& column, std::vector<EvaluatedCell>& list) {
    std::vector<const FolderCell*> withTimes;
    for (const FolderCell& cell : cells) {
        if (cell.a.done.empty() || cell.b.done.empty()) continue;
        const auto a = logsMs(cell.a, column), b = logsMs(cell.b, column);
        if (!a.empty() && !b.empty()) withTimes.push_back(&cell);
        list.push_back(evaluate(&cell, column, a, b));
    }
    if (withTimes.size() > 1)
        list.push_back(evaluate(nullptr, column, meansOverCells(withTimes, &FolderCell::a, column),
                                meansOverCells(withTimes, &FolderCell::b, column)));
}

}  // namespace

FolderComparison compareFolders(const ResultsSide& a, const ResultsSide& b, const std::vector<std::string>& columns,
                                bool acrossMachines) {
    FolderComparison comparison;
    comparison.cells = cellsOf(a, b);
    comparison.axes = distinguishingNames(comparison.cells);
    const FolderRemarks remarks(a, b, comparison.cells, comparison.axes);
    comparison.obstacles = remarks.obstacles();
    std::vector<std::string>& aboutMachines = acrossMachines ? comparison.remarks : comparison.obstacles;
    for (std::string& sentence : remarks.machines()) aboutMachines.push_back(std::move(sentence));
    for (std::string& sentence : remarks.rest()) comparison.remarks.push_back(std::move(sentence));

    for (const FolderCell& cell : comparison.cells)
        if (!cell.a.done.empty() && cell.a.failed.empty() && cell.a.invalid.empty() && !whyBroken(cell).empty())
            comparison.broken.push_back(&cell);
    if (comparison.obstacles.empty())
        for (const std::string& column : columns) evaluateColumn(comparison.cells, column, comparison.evaluated);
    return comparison;
}

std::string whyBroken(const FolderCell& cell) {
    if (!cell.b.failed.empty())
        return fmt::format("{}: {}", cell.b.failed.front()->status == RunStatus::timeout ? "timed out" : "failed",
                           cell.b.failed.front()->reason);
    return cell.b.invalid.empty() ? "" : "invalid: " + whyInvalid(*cell.b.invalid.front());
}

bool isSlowerBy(const EvaluatedCell& evaluated, double percent) {
    return evaluated.result.hasEnough() && evaluated.result.low > 1 + percent / 100;
}

}  // namespace dustbench::bench
