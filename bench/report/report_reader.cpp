#include "bench/report/report_reader.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <set>

#include "bench/report/older_rows.h"
#include "bench/report/picture_sets.h"
#include "bench/report/published_points.h"
#include "bench/report/run_groups.h"
#include "bench/results/compared_runs.h"
#include "bench/results/results_folder.h"
#include "bench/results/run_tables.h"
#include "bench/results/stored_run.h"
#include "bench/results/summary.h"
#include "bench/selfcheck/selfcheck_report.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::report {
namespace {

namespace fs = std::filesystem;

/// As readStoredRuns, but reports and skips damaged runs.
void readRuns(const fs::path& folder, ReportData& data) {
    std::error_code error;
    if (data.tablesOnly) {
        data.runs = results::readSummaryRuns(folder, data.problems);
        adoptOlderRows(data.runs, data.problems);
        const bool hasWarnings = fs::exists(folder / "runs.csv", error);
        data.problems.push_back(fmt::format("the folder contains only tables: frame times{} of its runs are not shown",
                                            hasWarnings ? " and pictures" : ", pictures and warnings"));
        return;
    }
    fs::directory_iterator entry(folder / "runs", error);
    if (error) {
        data.problems.push_back("there is no folder 'runs': nothing was measured, or this is not a results folder");
        return;
    }
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with('.')) continue;
        std::error_code why;
        if (!fs::is_directory(entry->path(), why)) {
            if (why) data.problems.push_back(fmt::format("left out: runs/{}: {}", name, why.message()));
            continue;
        }
        try {
            data.runs.emplace(name, results::readRunFolder(entry->path()));
        } catch (const InputError& fault) {
            data.problems.push_back(fmt::format("left out: {}", fault.what()));
        }
    }
    results::addMethodTimes(data.runs);
    if (data.runs.empty()) data.problems.push_back("the folder 'runs' contains no run");
    if (std::string said = results::saysNothingOfOutputs(data.runs); !said.empty())
        data.problems.push_back(std::move(said));
}

std::string provenanceOf(const results::StoredRun& run, std::string_view field) {
    const auto found = run.provenance.find(field);
    return found == run.provenance.end() ? std::string() : found->second;
}

void noteMixed(ReportData& data, const std::string& problem) {
    data.problems.push_back(problem);
    data.mixedMachines.push_back(problem);
}

/// Runs that a suite leaves out, or that ended early, never had a graphics device.
bool hadDevice(const results::StoredRun& run) {
    return run.status == results::RunStatus::done || !provenanceOf(run, "gl_renderer").empty();
}

MachineOfRun findMachines(ReportData& data) {
    MachineOfRun machineOf;
    std::vector<std::vector<std::string>> keys;
    const bool isAnyKnown = std::ranges::any_of(data.runs, [](const auto& entry) { return hadDevice(entry.second); });
    for (const auto& [id, run] : data.runs) {
        if (isAnyKnown && !hadDevice(run)) {
            machineOf[id] = 0;
            continue;
        }
        const std::vector<std::string> key = results::valuesOf(run, results::machineFields());
        auto found = std::ranges::find(keys, key);
        if (found == keys.end()) {
            found = keys.insert(keys.end(), key);
            data.machines.push_back(run.provenance);
        }
        machineOf[id] = static_cast<std::size_t>(found - keys.begin());
    }
    if (data.machines.size() > 1)
        noteMixed(data,
                  fmt::format(
                      "the runs are from {} different machines or kinds of build: their times are shown separately and "
                      "must not be compared",
                      data.machines.size()));
    return machineOf;
}

/// Comparing builds may be intended, but must be visible.
void noteBuilds(ReportData& data) {
    for (const std::string_view field : {"git_commit", "compiler", "gl_version"}) {
        std::set<std::string> values;
        // Twelve characters identify a commit.
        for (const auto& [id, run] : data.runs)
            if (hadDevice(run))
                values.insert(field == "git_commit" ? provenanceOf(run, field).substr(0, 12)
                                                    : provenanceOf(run, field));
        if (values.size() > 1)
            noteMixed(data, fmt::format("the runs differ in {}: {}", field, fmt::join(values, ", ")));
    }
}

/// Warnings that differ only in their numbers are of the same kind: every number becomes 0.
std::string withoutNumbers(std::string_view warning) {
    std::string kind;
    const auto isDigit = [&](std::size_t at) {
        return at < warning.size() && warning[at] >= '0' && warning[at] <= '9';
    };
    for (std::size_t at = 0; at < warning.size(); ++at) {
        kind += isDigit(at) ? '0' : warning[at];
        if (!isDigit(at)) continue;
        while (isDigit(at + 1) || (warning.substr(at + 1).starts_with('.') && isDigit(at + 2))) ++at;
    }
    return kind;
}

void noteWhatIsNotDone(ReportData& data) {
    std::map<std::string, RunWarnings> byKind;
    const auto noteWarning = [&byKind](const std::string& warning, const std::string& runId) {
        RunWarnings& kind = byKind[withoutNumbers(warning)];
        if (kind.warning.empty()) kind.warning = warning;
        kind.runs.push_back(runId);
    };
    for (const auto& [id, run] : data.runs) {
        if (run.status != results::RunStatus::done)
            data.notDone.push_back({id, std::string(results::runStatuses.wordOf(run.status)), run.reason});
        if (const auto invalid = run.cells.find("invalid"); invalid != run.cells.end() && !invalid->second.empty())
            noteWarning("invalid: " + invalid->second, id);
        for (const std::string& warning : run.warnings) noteWarning(warning, id);
    }
    for (auto& [kind, warnings] : byKind) data.warnings.push_back(std::move(warnings));
    std::ranges::stable_sort(data.warnings, std::greater(), [](const RunWarnings& entry) { return entry.runs.size(); });
    if (!data.notDone.empty())
        data.problems.push_back(fmt::format("{} of {} runs are not done", data.notDone.size(), data.runs.size()));
}

void noteUnknownColumns(ReportData& data) {
    std::set<std::string> known, unknown;
    for (const auto* list : {&results::columnsBeforeParameters(), &results::columnsAfterParameters()})
        known.insert(list->begin(), list->end());
    for (const auto& [id, run] : data.runs)
        for (const auto& [column, text] : run.cells)
            if (!known.contains(column) && !column.starts_with("p.")) unknown.insert(column);
    if (!unknown.empty())
        data.problems.push_back(
            fmt::format("columns unknown to this version are left out: {}", fmt::join(unknown, ", ")));
}

/// Sorts a paper's experiments in the paper's order, each quick run after the full one.
void inOrderOf(const suite::Paper& paper, std::vector<RunGroup>& groups) {
    const auto place = [&paper](const RunGroup& group) {
        return std::pair(std::ranges::find(paper.suites, group.suite) - paper.suites.begin(), group.id);
    };
    const auto isOurs = [&paper](const RunGroup& group) { return group.paper == paper.id; };
    const auto rest = std::ranges::stable_partition(groups, isOurs);
    std::ranges::sort(groups.begin(), rest.begin(), {}, place);
}

std::set<std::string> controlsOf(const std::string& paper) {
    try {
        const std::vector<std::string> controls = suite::loadPaper(paper).controls;
        return {controls.begin(), controls.end()};
    } catch (const InputError&) {  // which readPapers reports
        return {};
    }
}

/// The tables in the folder of the page, to which it links.
void listFiles(const fs::path& folder, ReportData& data) {
    for (const char* name : {"summary.csv", "claims.csv", "experiments.csv", "machine.csv", "cinema.cdb/data.csv"})
        // claims.csv is written together with the page.
        if (std::error_code none;
            fs::exists(folder / name, none) || (name == std::string_view("claims.csv") && !data.claims.empty()))
            data.files.emplace_back(name);
}

/// A wrong row is reported and does not affect the rest of the page.
void placePublished(const std::string& paper, ReportData& data) {
    try {
        const auto published = readPublished(paper);
        for (RunGroup& group : data.groups)
            if (const auto found = published.find(group.suite); found != published.end())
                group.published = publishedIn(group, found->second);
    } catch (const InputError& fault) {
        data.problems.push_back(fmt::format("paper {}: published numbers are not shown: {}", paper, fault.what()));
    }
}

/// The claims of a paper, from the runs: summary.csv may differ from them. Those about the device are judged for each
/// machine by itself.
std::vector<claims::EvaluatedClaim> claimsOf(const std::string& paper, const fs::path& folder, const ReportData& data,
                                             const MachineOfRun& machineOf) {
    const auto evaluate = [&](const results::StoredRuns& runs) {
        return claims::evaluateClaims(
            paper, files::CsvTable::parseText(results::summaryCsv(runs), (folder / "summary.csv").string()),
            claims::readFindings(folder));
    };
    std::vector<claims::EvaluatedClaim> claims = evaluate(data.runs);
    if (data.machines.size() < 2) return claims;
    std::vector<std::vector<claims::ClaimVerdict>> ofMachines(claims.size());
    for (std::size_t machine = 0; machine < data.machines.size(); ++machine) {
        results::StoredRuns runs = data.runs;
        std::erase_if(runs, [&](const auto& entry) { return machineOf.at(entry.first) != machine; });
        const std::vector<claims::EvaluatedClaim> own = evaluate(runs);
        for (std::size_t i = 0; i < own.size(); ++i) ofMachines[i].push_back(own[i].result.verdict);
    }
    for (std::size_t i = 0; i < claims.size(); ++i) claims::tellByMachine(claims[i], ofMachines[i]);
    return claims;
}

void readPapers(const fs::path& folder, const MachineOfRun& machineOf, ReportData& data) {
    const std::set<std::string> ids = papersOf(data.groups);
    if (ids.empty()) return;
    for (const std::string& id : ids) {
        try {
            data.papers.push_back(suite::loadPaper(id));
            inOrderOf(data.papers.back(), data.groups);
            placePublished(id, data);
            std::ranges::move(claimsOf(id, folder, data, machineOf), std::back_inserter(data.claims));
        } catch (const InputError& fault) {
            data.problems.push_back(fmt::format("paper {}: {}", id, fault.what()));
        }
    }
}

}  // namespace

std::set<std::string> papersOf(const std::vector<RunGroup>& groups) {
    std::map<std::string, std::set<std::string>> suitesOfPaper;
    for (const RunGroup& group : groups)
        if (!group.paper.empty()) suitesOfPaper[group.paper].insert(group.suite);
    std::set<std::string> lent, ids, all;
    for (const auto& [id, suites] : suitesOfPaper) lent.merge(controlsOf(id));
    for (const auto& [id, suites] : suitesOfPaper) {
        all.insert(id);
        if (!std::ranges::includes(lent, suites)) ids.insert(id);
    }
    return ids.empty() ? all : ids;
}

ReportData readReport(const fs::path& folder, std::int64_t maximumPictureBytes) {
    if (!fs::is_directory(folder))
        throw InputError(
            fmt::format("'{}': not a folder, expected one written by `suite`, `run` or `reproduce`", folder.string()));
    ReportData data;
    const fs::path whole = fs::absolute(folder).lexically_normal();
    data.folder = (whole.has_filename() ? whole.filename() : whole.parent_path().filename()).string();
    data.writtenUtc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::now()));
    data.tablesOnly = results::holdsTablesAlone(folder);
    data.problems = selfcheck::selfcheckProblems(folder);
    readRuns(folder, data);
    const MachineOfRun machineOf = findMachines(data);
    noteBuilds(data);
    noteWhatIsNotDone(data);
    noteUnknownColumns(data);
    data.groups = sortIntoGroups(data.runs, machineOf, data.problems);
    readPapers(folder, machineOf, data);
    listFiles(folder, data);
    if (data.tablesOnly) return data;
    readFrameTimes(folder, data);
    collectPictures(folder, maximumPictureBytes, data);
    return data;
}

FrameTimes condense(const std::vector<double>& frameMs) {
    FrameTimes times;
    times.frames = frameMs.size();
    if (frameMs.empty()) return times;
    const auto [minimum, maximum] = std::ranges::minmax(frameMs);
    times.minimumMs = minimum;
    // 2·∛n bins, Rice's rule: enough to reveal two speeds, few enough to smooth single frames.
    const auto wanted = static_cast<std::size_t>(std::lround(2 * std::cbrt(static_cast<double>(frameMs.size()))));
    const std::size_t bins = std::clamp(wanted, minimumBins, maximumBins);
    times.binMs = (maximum - minimum) / static_cast<double>(bins);
    times.bins.assign(times.binMs > 0 ? bins : 1, 0);
    for (const double ms : frameMs) {
        const auto bin = times.binMs > 0 ? static_cast<std::size_t>((ms - minimum) / times.binMs) : 0;
        ++times.bins[std::min(bin, times.bins.size() - 1)];
    }

    const std::size_t stretches = std::min(frameMs.size(), maximumTracePoints / 2);
    for (std::size_t stretch = 0; stretch < stretches; ++stretch) {
        const std::size_t begin = stretch * frameMs.size() / stretches,
                          end = (stretch + 1) * frameMs.size() / stretches;
        std::size_t lowest = begin, highest = begin;
        for (std::size_t frame = begin; frame < end; ++frame) {
            if (frameMs[frame] < frameMs[lowest]) lowest = frame;
            if (frameMs[frame] > frameMs[highest]) highest = frame;
        }
        const auto [first, second] = std::minmax(lowest, highest);
        times.trace.emplace_back(first, frameMs[first]);
        if (second != first) times.trace.emplace_back(second, frameMs[second]);
    }
    return times;
}

void readFrameTimes(const std::filesystem::path& folder, ReportData& data) {
    struct Candidate {
        const results::StoredRun* run;
        std::string group, label;
    };
    std::vector<Candidate> candidates;
    std::set<const results::StoredRun*> known;
    for (const RunGroup& group : data.groups)
        for (const ReportCell& cell : group.cells)
            if (!cell.done.empty() && cell.done.front()->cells.contains("frame_ms_median") &&
                known.insert(cell.done.front()).second) {
                const std::string world = worldLabel(group, cell);
                candidates.push_back(
                    {cell.done.front(), group.id, variantLabel(group, cell) + (world.empty() ? "" : ", " + world)});
            }

    const std::size_t kept = std::min(candidates.size(), maximumRunsWithFrameTimes);
    data.runsWithoutFrameTimes = candidates.size() - kept;
    std::size_t unread = 0;
    std::string firstFault;
    for (std::size_t index = 0; index < kept; ++index) {
        const Candidate& candidate = candidates[index * candidates.size() / kept];
        const std::filesystem::path file = folder / "runs" / candidate.run->runId / "frames.csv";
        try {
            const auto table = files::CsvTable::parseFile(file);
            std::vector<double> frameMs;
            for (std::size_t row = 0; row < table.rows(); ++row) frameMs.push_back(table.number(row, "frame_ms"));
            FrameTimes times = condense(frameMs);
            times.runId = candidate.run->runId;
            times.group = candidate.group;
            times.label = candidate.label;
            data.frameTimes.push_back(std::move(times));
        } catch (const InputError& error) {
            if (unread++ == 0) firstFault = error.what();
        }
    }
    if (unread > 0)
        data.problems.push_back(
            fmt::format("frame times of {} runs cannot be read; the first error: {}", unread, firstFault));
}

}  // namespace dustbench::report
