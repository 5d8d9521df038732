#include "bench/report/machines/hardware_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>

#include "methods/kit/files/csv.h"
#include "methods/kit/gpu/adapter.h"

namespace dustbench::bench {
namespace {

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
    for (const StoredRun* run : side.runs) {
        const auto commit = run->provenance.find("git_commit"), dirty = run->provenance.find("git_dirty");
        if (run->status != RunStatus::done || commit == run->provenance.end() || commit->second.empty()) continue;
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
    const auto done = std::ranges::count(side.runs, RunStatus::done, &StoredRun::status);
    return fmt::format("{} of {}", done, side.runs.size());
}

/// `the machine is busy (12 runs); frames stalled (3 runs)`: kinds of warnings end before their first colon.
std::string warningsOf(const MachineSet& set, const MachineSide& side) {
    std::vector<std::string> kinds;
    for (const RunWarnings& warnings : set.folders[side.folder].warnings) {
        const auto count = std::ranges::count_if(side.runs, [&](const StoredRun* run) {
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

}  // namespace

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

}  // namespace dustbench::bench
