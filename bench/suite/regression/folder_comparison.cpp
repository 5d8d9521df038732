#include "bench/suite/regression/folder_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/results/compared_runs.h"
#include "bench/suite/planned_evaluation.h"
#include "bench/suite/regression/folder_cells.h"

namespace dustbench::suite {
namespace {

/// Why two results folders cannot be compared, and differences other than times. Each sentence is one line. Keeps
/// references.
class FolderRemarks {
 public:
    FolderRemarks(const ResultsSide& a, const ResultsSide& b, const std::vector<FolderCell>& cells,
                  const std::vector<std::string>& distinguishingNames)
        : a_(a), b_(b), cells_(cells), distinguishingNames_(distinguishingNames) {}

    /// No common configuration, only copied runs, or configurations whose runs did different work: other inputs, or a
    /// different final state.
    std::vector<std::string> obstacles() const;
    /// Configurations whose runs are from different machines or builds.
    std::vector<std::string> machines() const;
    /// Runs in only one folder, failed and invalid runs, runs from debug builds or with warnings, and other differences
    /// between the two programs.
    std::vector<std::string> rest() const;

 private:
    std::string nothingInCommon() const;
    /// The number of runs that were copied between the folders, as a sentence; empty if there are none.
    std::string copies() const;
    std::string nameOf(const FolderCell& cell) const { return labelOf(cell, distinguishingNames_); }

    const ResultsSide& a_;
    const ResultsSide& b_;
    const std::vector<FolderCell>& cells_;
    const std::vector<std::string>& distinguishingNames_;
};

bool isInBoth(const FolderCell& cell) {
    return !cell.a.done.empty() && !cell.b.done.empty();
}

std::string quantity(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// The configuration's runs that are done, with the letter of their folder, A first.
std::vector<std::pair<const results::StoredRun*, char>> doneRuns(const FolderCell& cell) {
    std::vector<std::pair<const results::StoredRun*, char>> runs;
    runs.reserve(cell.a.done.size() + cell.b.done.size());
    for (const results::StoredRun* run : cell.a.done) runs.emplace_back(run, 'A');
    for (const results::StoredRun* run : cell.b.done) runs.emplace_back(run, 'B');
    return runs;
}

/// `cpu: 'X' in A and 'Y' in B`, with the number of affected configurations.
std::map<std::string, std::size_t> differencesWithin(const std::vector<FolderCell>& cells,
                                                     std::span<const std::string_view> fields) {
    std::map<std::string, std::size_t> cellCounts;
    for (const FolderCell& cell : cells) {
        if (!isInBoth(cell)) continue;
        const auto runs = doneRuns(cell);
        std::set<std::string> sentences;
        for (const auto& [run, letter] : runs)
            for (const results::FieldDifference& found : results::differences(*runs.front().first, *run, fields))
                sentences.insert(fmt::format("{}: '{}' in {} and '{}' in {}", found.field, found.first,
                                             runs.front().second, found.second, letter));
        for (const std::string& sentence : sentences) ++cellCounts[sentence];
    }
    return cellCounts;
}

std::vector<std::string> withCounts(const std::map<std::string, std::size_t>& cellCounts) {
    std::vector<std::string> sentences;
    sentences.reserve(cellCounts.size());
    for (const auto& [sentence, count] : cellCounts)
        sentences.push_back(fmt::format("{} ({})", sentence, quantity(count, "configuration")));
    return sentences;
}

void addInvalid(const ResultsSide& side, char letter, std::vector<std::string>& list) {
    std::vector<const results::StoredRun*> done;
    for (const auto& [id, run] : side.runs)
        if (run.status == results::RunStatus::done) done.push_back(&run);
    if (const std::string said = results::saysInvalid(done); !said.empty())
        list.push_back(fmt::format("{}: {}", letter, said));
}

void addBuildsAndWarnings(const ResultsSide& side, char letter, std::vector<std::string>& list) {
    std::map<std::string, std::size_t> builds;
    std::size_t done = 0, warned = 0;
    std::string example;
    for (const auto& [id, run] : side.runs) {
        if (run.status != results::RunStatus::done) continue;
        ++done;
        if (const auto build = run.provenance.find("build_type");
            build != run.provenance.end() && build->second != "Release")
            ++builds[build->second];
        if (run.warnings.empty()) continue;
        ++warned;
        if (example.empty()) example = run.warnings.front();
    }
    for (const auto& [build, count] : builds)
        list.push_back(fmt::format("{}: {} of {} were measured by a '{}' build, not 'Release'", letter, count,
                                   quantity(done, "run"), build));
    if (warned > 0)
        list.push_back(
            fmt::format("{}: {} of {} carry warnings, the first: {}", letter, warned, quantity(done, "run"), example));
}

std::string FolderRemarks::nothingInCommon() const {
    std::string text = fmt::format("no configuration is done and valid in both: {} of {} in A, {} of {} in B",
                                   quantity(static_cast<std::size_t>(std::ranges::count_if(
                                                cells_, [](const auto& cell) { return cell.a.count() > 0; })),
                                            "configuration"),
                                   quantity(a_.runs.size(), "run"),
                                   quantity(static_cast<std::size_t>(std::ranges::count_if(
                                                cells_, [](const auto& cell) { return cell.b.count() > 0; })),
                                            "configuration"),
                                   quantity(b_.runs.size(), "run"));
    // If nearly everything is equal, the difference is probably a mistake.
    const auto mine = std::ranges::find_if(cells_, [](const FolderCell& cell) { return !cell.a.done.empty(); });
    std::vector<std::string> nearest;
    for (const FolderCell& theirs : cells_) {
        if (mine == cells_.end() || theirs.b.done.empty()) continue;
        std::vector<std::string> names;
        for (const auto& [name, value] : mine->identity)
            if (theirs.valueOf(name) != value) names.push_back(name);
        for (const auto& [name, value] : theirs.identity)
            if (!value.empty() && mine->valueOf(name).empty()) names.push_back(name);
        if (nearest.empty() || names.size() < nearest.size()) nearest = names;
    }
    for (std::size_t i = 0; i < nearest.size(); ++i)
        text += (i ? ", " : "; the first of A and the most similar one of B differ in ") + nearest[i];
    return text;
}

std::string FolderRemarks::copies() const {
    std::size_t count = 0;
    for (const FolderCell& cell : cells_) count += cell.b.copied.size();
    if (count == 0) return "";
    return fmt::format(
        "{} of B {} copied from A, or A's from B: left out, because a measurement cannot be compared with itself",
        quantity(count, "run"), count == 1 ? "is" : "are");
}

std::vector<std::string> FolderRemarks::obstacles() const {
    std::vector<std::string> list;
    if (std::ranges::none_of(cells_, isInBoth)) {
        std::string copied = copies();
        list.push_back(copied.empty() ? nothingInCommon() : std::move(copied));
    }
    for (const FolderCell& cell : cells_) {
        if (!isInBoth(cell)) continue;
        const auto runs = doneRuns(cell);
        const auto& [first, firstLetter] = runs.front();
        for (const auto& [run, letter] : runs) {
            const std::string file = results::differingInput(*first, *run);
            if (file.empty() && run->stateHash == first->stateHash) continue;
            const std::string what = file.empty() ? fmt::format("state_hash '{}' in {} and '{}' in {}",
                                                                first->stateHash, firstLetter, run->stateHash, letter)
                                                  : fmt::format("{} differs between {} ({}) and {} ({})", file,
                                                                firstLetter, first->runId, letter, run->runId);
            list.push_back(fmt::format("{}: the runs did different work: {}", nameOf(cell), what));
            break;
        }
    }
    return list;
}

std::vector<std::string> FolderRemarks::machines() const {
    return withCounts(differencesWithin(cells_, results::machineFields()));
}

std::vector<std::string> FolderRemarks::rest() const {
    std::vector<std::string> list = withCounts(differencesWithin(cells_, results::circumstanceFields()));
    if (std::string copied = copies(); !copied.empty()) list.push_back(std::move(copied));
    addInvalid(a_, 'A', list);
    addInvalid(b_, 'B', list);
    addBuildsAndWarnings(a_, 'A', list);
    addBuildsAndWarnings(b_, 'B', list);
    for (const FolderCell& cell : cells_) {
        for (const auto& [runs, letter, others] :
             {std::tuple(&cell.a, 'A', &cell.b), std::tuple(&cell.b, 'B', &cell.a)}) {
            if (others->count() == 0)
                list.push_back(fmt::format("{}: only in {}, {}", nameOf(cell), letter, quantity(runs->count(), "run")));
            for (const auto& [bad, what] : {std::pair(&runs->failed, "failed"), {&runs->skipped, "skipped"}})
                if (!bad->empty())
                    list.push_back(fmt::format("{}: {} of {} {} in {}: {}", nameOf(cell), bad->size(),
                                               quantity(runs->count(), "run"), what, letter, bad->front()->reason));
        }
        if (isInBoth(cell) && cell.a.done.front()->methodHash != cell.b.done.front()->methodHash)
            list.push_back(fmt::format("{}: the final state of the method differs (method_hash)", nameOf(cell)));
    }
    return list;
}

/// ln of the time in ms; empty without a time above 0.
std::optional<double> logMs(const results::StoredRun& run, const std::string& column) {
    const auto number = numberIn(run, column);
    if (!number || !(*number > 0) || !std::isfinite(*number)) return std::nullopt;
    return isRate(column) ? std::log(1000.0) - std::log(*number) : std::log(*number);
}

std::vector<double> logsMs(const CellRuns& runs, const std::string& column) {
    std::vector<double> logs;
    for (const results::StoredRun* run : runs.done)
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
    EvaluatedCell evaluated{cell, column, geometricMean(a), geometricMean(b), measure::compareUnpairedLogs(b, a), ""};
    if (a.empty() || b.empty())
        evaluated.reason = fmt::format("no time above 0 in {}", a.empty() ? "A" : "B");
    else if (!evaluated.result.hasEnough())
        evaluated.reason = fmt::format("{} and {} {}, {} of each are needed", a.size(), b.size(),
                                       cell ? "runs" : "complete repetitions", measure::minimumTimes);
    return evaluated;
}

/// One number per repetition: the mean over the configurations, if all have a value.
std::vector<double> meansOverCells(const std::vector<const FolderCell*>& cells, const CellRuns FolderCell::*side,
                                   const std::string& column) {
    std::map<std::string, std::pair<double, std::size_t>> sums;  // by repetition
    for (const FolderCell* cell : cells)
        for (const results::StoredRun* run : (cell->*side).done)
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
        return fmt::format("{}: {}",
                           cell.b.failed.front()->status == results::RunStatus::timeout ? "timed out" : "failed",
                           cell.b.failed.front()->reason);
    return cell.b.invalid.empty() ? "" : "invalid: " + results::whyInvalid(*cell.b.invalid.front());
}

bool isSlowerBy(const EvaluatedCell& evaluated, double percent) {
    return evaluated.result.hasEnough() && evaluated.result.low > 1 + percent / 100;
}

}  // namespace dustbench::suite
