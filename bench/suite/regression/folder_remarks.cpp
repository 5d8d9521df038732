#include "bench/suite/regression/folder_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "bench/results/compared_runs.h"

namespace dustbench::bench {
namespace {

bool isInBoth(const FolderCell& cell) {
    return !cell.a.done.empty() && !cell.b.done.empty();
}

std::string quantity(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// The configuration's runs that are done, with the letter of their folder, A first.
std::vector<std::pair<const StoredRun*, char>> doneRuns(const FolderCell& cell) {
    std::vector<std::pair<const StoredRun*, char>> runs;
    runs.reserve(cell.a.done.size() + cell.b.done.size());
    for (const StoredRun* run : cell.a.done) runs.emplace_back(run, 'A');
    for (const StoredRun* run : cell.b.done) runs.emplace_back(run, 'B');
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
            for (const FieldDifference& found : differences(*runs.front().first, *run, fields))
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
    std::vector<const StoredRun*> done;
    for (const auto& [id, run] : side.runs)
        if (run.status == RunStatus::done) done.push_back(&run);
    if (const std::string said = saysInvalid(done); !said.empty()) list.push_back(fmt::format("{}: {}", letter, said));
}

void addBuildsAndWarnings(const ResultsSide& side, char letter, std::vector<std::string>& list) {
    std::map<std::string, std::size_t> builds;
    std::size_t done = 0, warned = 0;
    std::string example;
    for (const auto& [id, run] : side.runs) {
        if (run.status != RunStatus::done) continue;
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

}  // namespace

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
            const std::string file = differingInput(*first, *run);
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
    return withCounts(differencesWithin(cells_, machineFields()));
}

std::vector<std::string> FolderRemarks::rest() const {
    std::vector<std::string> list = withCounts(differencesWithin(cells_, circumstanceFields()));
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

}  // namespace dustbench::bench
