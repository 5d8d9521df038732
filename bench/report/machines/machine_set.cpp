#include "bench/report/machines/machine_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/report/report_reader.h"
#include "bench/results/compared_runs.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"

namespace dustbench::bench {
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
                    const std::vector<std::vector<std::string>>& machines, const StoredRun& run) {
    const auto found = std::ranges::find(machines, valuesOf(run, machineFields()));
    const auto index = found == machines.end() ? 0 : found - machines.begin();
    return sides[first + static_cast<std::size_t>(index)];
}

void addSides(const ReportData& data, std::size_t folder, const std::string& label, std::vector<MachineSide>& sides) {
    std::vector<std::vector<std::string>> machines;
    for (const auto& [id, run] : data.runs)
        if (std::vector<std::string> values = valuesOf(run, machineFields());
            run.status == RunStatus::done && std::ranges::find(machines, values) == machines.end())
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
        if (run.status != RunStatus::done) continue;
        for (const auto& [field, value] : run.provenance)
            if (field != "key" && !value.empty()) side.facts[field].insert(value);
    }
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

}  // namespace dustbench::bench
