#include "bench/report/machines/machine_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>

#include "bench/report/report_reader.h"
#include "bench/results/compared_runs.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/gpu/adapter.h"

namespace dustbench::report {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longestLabel = 60;

fs::path wholePath(const fs::path& folder) {
    const fs::path whole = fs::absolute(folder).lexically_normal();
    return whole.has_filename() ? whole : whole.parent_path();
}

/// The last `count` parts of a path.
std::string endOf(const fs::path& path, std::size_t count) {
    const std::vector<fs::path> parts(path.begin(), path.end());
    fs::path end;
    for (std::size_t i = parts.size() - std::min(count, parts.size()); i < parts.size(); ++i) end /= parts[i];
    return end.string();
}

bool areUnique(const std::vector<std::string>& names) {
    return std::set<std::string>(names.begin(), names.end()).size() == names.size();
}

void requireDifferentFolders(const std::vector<fs::path>& folders) {
    if (folders.size() < 2)
        throw InputError(fmt::format("machines: got {} folder, allowed: two or more", folders.size()));
    std::set<fs::path> seen;
    for (const fs::path& folder : folders) {
        std::error_code none;
        const fs::path real = fs::canonical(folder, none);
        if (!none && !seen.insert(real).second)
            throw InputError(fmt::format("'{}': given more than once, expected different folders", folder.string()));
    }
}

void requireLabels(const std::vector<std::string>& labels, std::size_t folders) {
    if (labels.size() != folders)
        throw InputError(
            fmt::format("--label: got {} for {} folders, allowed: one for each, or none", labels.size(), folders));
    for (const std::string& label : labels)
        if (label.empty() || label.size() > longestLabel || files::printable(label) != label)
            throw InputError(
                fmt::format("--label: got '{}', allowed: 1..{} printable characters", label, longestLabel));
    if (!areUnique(labels))
        throw InputError(fmt::format("--label: got '{}', expected different labels", fmt::join(labels, "', '")));
}

/// Runs that ended before they had a graphics device have no machine; they are assigned to the first one.
MachineSide& sideOf(std::vector<MachineSide>& sides, std::size_t first,
                    const std::vector<std::vector<std::string>>& machines, const results::StoredRun& run) {
    const auto found = std::ranges::find(machines, results::valuesOf(run, results::machineFields()));
    const auto index = found == machines.end() ? 0 : found - machines.begin();
    return sides[first + static_cast<std::size_t>(index)];
}

void addSides(const ReportData& data, std::size_t folder, const std::string& label, std::vector<MachineSide>& sides) {
    std::vector<std::vector<std::string>> machines;
    for (const auto& [id, run] : data.runs)
        if (std::vector<std::string> values = results::valuesOf(run, results::machineFields());
            run.status == results::RunStatus::done && std::ranges::find(machines, values) == machines.end())
            machines.push_back(std::move(values));
    if (machines.empty())
        throw InputError(
            fmt::format("'{}': contains no completed and readable run, expected a results folder written by "
                        "`suite`, `run`, `compare` or `reproduce`",
                        data.folder));
    const std::size_t first = sides.size();
    for (std::size_t i = 0; i < machines.size(); ++i)
        sides.push_back({machines.size() == 1 ? label : fmt::format("{} (machine {})", label, i + 1), folder, {}, {}});
    for (const auto& [id, run] : data.runs) {
        MachineSide& side = sideOf(sides, first, machines, run);
        side.runs.push_back(&run);
        if (run.status != results::RunStatus::done) continue;
        for (const auto& [field, value] : run.provenance)
            if (field != "key" && !value.empty()) side.facts[field].insert(value);
    }
}

using Text = std::function<std::string(const MachineSet&, const MachineSide&)>;

std::string memoryOf(const MachineSide& side) {
    const auto found = side.facts.find("ram_bytes");
    if (found == side.facts.end()) return {};
    std::set<std::string> sizes;
    for (const std::string& text : found->second)
        if (const auto bytes = files::numberOf(text)) sizes.insert(fmt::format("{:.1f} GiB", *bytes / (1LL << 30)));
    return fmt::format("{}", fmt::join(sizes, ", "));
}

std::string rendererOf(const MachineSide& side) {
    const std::string renderer = factOf(side, "gl_renderer");
    return isSoftware(side) ? "software: " + renderer : renderer;
}

std::string commitOf(const MachineSide& side) {
    std::set<std::string> commits;
    for (const results::StoredRun* run : side.runs) {
        const auto commit = run->provenance.find("git_commit"), dirty = run->provenance.find("git_dirty");
        if (run->status != results::RunStatus::done || commit == run->provenance.end() || commit->second.empty())
            continue;
        const bool isDirty = dirty != run->provenance.end() && dirty->second == "true";
        commits.insert(commit->second.substr(0, 12) + (isDirty ? " with uncommitted changes" : ""));
    }
    return fmt::format("{}", fmt::join(commits, ", "));
}

/// Dates of the first and the last run: `2026-03-01 10:20 to 2026-03-01 11:05 UTC`.
std::string datesOf(const MachineSide& side) {
    const auto found = side.facts.find("started_utc");
    if (found == side.facts.end()) return {};
    const auto minute = [](std::string text) {
        text = text.substr(0, 16);
        std::ranges::replace(text, 'T', ' ');
        return text;
    };
    const std::string first = minute(*found->second.begin()), last = minute(*found->second.rbegin());
    return first == last ? first + " UTC" : fmt::format("{} to {} UTC", first, last);
}

std::string countsOf(const MachineSide& side) {
    const auto done = std::ranges::count(side.runs, results::RunStatus::done, &results::StoredRun::status);
    return fmt::format("{} of {}", done, side.runs.size());
}

/// `the machine is busy (12 runs); frames stalled (3 runs)`: kinds of warnings end before their first colon.
std::string warningsOf(const MachineSet& set, const MachineSide& side) {
    std::vector<std::string> kinds;
    for (const RunWarnings& warnings : set.folders[side.folder].warnings) {
        const auto count = std::ranges::count_if(side.runs, [&](const results::StoredRun* run) {
            return std::ranges::find(warnings.runs, run->runId) != warnings.runs.end();
        });
        if (count > 0)
            kinds.push_back(fmt::format("{} ({} {})", warnings.warning.substr(0, warnings.warning.find(':')), count,
                                        count == 1 ? "run" : "runs"));
    }
    return kinds.empty() ? "none" : fmt::format("{}", fmt::join(kinds, "; "));
}

Text field(const char* name) {
    return [name](const MachineSet&, const MachineSide& side) { return factOf(side, name); };
}

Text of(std::string (*text)(const MachineSide&)) {
    return [text](const MachineSet&, const MachineSide& side) { return text(side); };
}

std::string virtualText(const MachineSide& side) {
    const std::string text = factOf(side, "virtual_machine");
    return text == "true" ? "yes" : text == "false" ? "no" : text;
}

/// The first input that differs from those of the cell's first run, or `state_hash`; empty if none differs.
std::string otherWorkIn(const MachineCell& cell) {
    const results::StoredRun* first = nullptr;
    for (const suite::CellRuns& runs : cell.sides)
        for (const results::StoredRun* run : runs.done) {
            if (!first) first = run;
            if (std::string file = results::differingInput(*first, *run); !file.empty()) return file;
            if (run->stateHash != first->stateHash) return "state_hash";
        }
    return {};
}

}  // namespace

std::string factOf(const MachineSide& side, std::string_view field) {
    const auto found = side.facts.find(field);
    return found == side.facts.end() ? std::string() : fmt::format("{}", fmt::join(found->second, ", "));
}

std::vector<std::string> folderLabels(const std::vector<fs::path>& folders) {
    std::vector<std::string> labels;
    for (std::size_t count = 1; labels.empty() || !areUnique(labels); ++count) {
        labels.clear();
        bool isWhole = true;
        for (const fs::path& folder : folders) {
            const fs::path whole = wholePath(folder);
            labels.push_back(endOf(whole, count));
            isWhole = isWhole && count >= static_cast<std::size_t>(std::distance(whole.begin(), whole.end()));
        }
        if (isWhole) break;
    }
    return labels;
}

MachineSet machineSet(std::vector<ReportData> folders, std::vector<std::string> labels) {
    MachineSet set;
    set.folders = std::move(folders);
    set.labels = std::move(labels);
    for (std::size_t i = 0; i < set.folders.size(); ++i) addSides(set.folders[i], i, set.labels[i], set.sides);
    return set;
}

MachineSet readMachines(const std::vector<fs::path>& folders, const std::vector<std::string>& labels) {
    requireDifferentFolders(folders);
    if (!labels.empty()) requireLabels(labels, folders.size());
    std::vector<ReportData> read;
    read.reserve(folders.size());  // reallocation could copy, and pointers into the runs would dangle
    for (const fs::path& folder : folders) {
        read.push_back(readReport(folder, 0));
        read.back().folder = folder.string();
    }
    return machineSet(std::move(read), labels.empty() ? folderLabels(folders) : labels);
}

bool HardwareRow::differs() const {
    return std::ranges::any_of(values, [this](const std::string& value) { return value != values.front(); });
}

bool isSoftware(const MachineSide& side) {
    const auto found = side.facts.find("gl_renderer");
    return found != side.facts.end() && std::ranges::all_of(found->second, gpu::isSoftwareRenderer);
}

bool areAlike(const MachineSide& a, const MachineSide& b) {
    return memoryOf(a) == memoryOf(b) &&
           std::ranges::all_of(std::array{"cpu", "cores", "gl_vendor", "gl_renderer", "virtual_machine"},
                               [&](const char* name) { return factOf(a, name) == factOf(b, name); });
}

std::vector<HardwareRow> hardwareTable(const MachineSet& set) {
    const std::vector<std::pair<const char*, Text>> rows{
        {"CPU", field("cpu")},
        {"cores", field("cores")},
        {"memory", of(memoryOf)},
        {"OpenGL renderer", of(rendererOf)},
        {"OpenGL vendor", field("gl_vendor")},
        {"OpenGL version and driver", field("gl_version")},
        {"platform", field("gl_platform")},
        {"kernel", field("kernel")},
        {"governor", field("governor")},
        {"virtual machine", of(virtualText)},
        {"dustbench", field("version")},
        {"commit", of(commitOf)},
        {"compiler", field("compiler")},
        {"flags", field("flags")},
        {"build", field("build_type")},
        {"measured", of(datesOf)},
        {"runs done", of(countsOf)},
        {"warnings", warningsOf},
        {"folder", [](const MachineSet& all, const MachineSide& side) { return all.folders[side.folder].folder; }},
    };
    std::vector<HardwareRow> table;
    for (const auto& [name, text] : rows) {
        table.push_back({name, {}});
        for (const MachineSide& side : set.sides) table.back().values.push_back(text(set, side));
    }
    return table;
}

std::size_t MachineCell::sidesDone() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(sides, [](const suite::CellRuns& runs) { return !runs.done.empty(); }));
}

bool MachineCells::haveSomethingInCommon() const {
    return std::ranges::any_of(cells,
                               [](const MachineCell& cell) { return cell.otherWork.empty() && cell.sidesDone() > 1; });
}

MachineCells cellsOf(const MachineSet& set) {
    std::map<suite::CellIdentity, MachineCell, decltype(&suite::identityLess)> found(&suite::identityLess);
    MachineCells result;
    std::map<std::string, std::vector<const results::StoredRun*>> placed;  // by run id, of previous sides
    for (std::size_t side = 0; side < set.sides.size(); ++side) {
        std::size_t unplaced = 0, copied = 0;
        for (const results::StoredRun* run : set.sides[side].runs) {
            suite::CellIdentity identity;
            try {
                identity = suite::identityOf(*run);
            } catch (const InputError&) {
                ++unplaced;
                continue;
            }
            MachineCell& cell = found[identity];
            cell.identity = std::move(identity);
            cell.sides.resize(set.sides.size());
            std::vector<const results::StoredRun*>& before = placed[run->runId];
            if (std::ranges::any_of(before, [run](const results::StoredRun* other) {
                    return results::areOneMeasurement(*other, *run);
                })) {
                cell.sides[side].copied.push_back(run);
                ++copied;
                continue;
            }
            before.push_back(run);
            suite::add(cell.sides[side], *run);
        }
        if (copied > 0)
            result.unplaced.push_back(fmt::format("{}: {} of {} runs were copied from another folder and are left out",
                                                  set.sides[side].label, copied, set.sides[side].runs.size()));
        if (unplaced > 0)
            result.unplaced.push_back(fmt::format("{}: {} of {} runs do not record their settings (provenance.key)",
                                                  set.sides[side].label, unplaced, set.sides[side].runs.size()));
    }
    std::vector<suite::CellIdentity> identities;
    for (auto& [identity, cell] : found) {
        cell.otherWork = otherWorkIn(cell);
        identities.push_back(identity);
        result.cells.push_back(std::move(cell));
    }
    result.names = suite::distinguishingNames(identities);
    return result;
}

}  // namespace dustbench::report
