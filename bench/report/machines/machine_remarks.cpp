#include "bench/report/machines/machine_remarks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "bench/report/machines/machine_set.h"
#include "bench/results/compared_runs.h"

namespace dustbench::report {
namespace {

using Names = std::vector<std::string>;
/// Values of one field by machine; empty for a machine without it.
using SideValues = std::vector<std::set<std::string>>;

constexpr std::size_t namedValues = 6;

/// `a, b and c`
std::string listOf(const Names& names) {
    if (names.size() < 2) return fmt::format("{}", fmt::join(names, ""));
    return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::string valuesText(const std::set<std::string>& values) {
    Names named;
    for (const std::string& value : values) {
        if (named.size() == namedValues) return fmt::format("{} … ({} values)", fmt::join(named, ", "), values.size());
        named.push_back(value.empty() ? "none" : value);
    }
    return fmt::format("{}", fmt::join(named, ", "));
}

std::string parameterName(const std::string& name) {
    return name.starts_with("p.") ? name.substr(2) : name;
}

bool haveCommon(const std::set<std::string>& a, const std::set<std::string>& b) {
    return std::ranges::any_of(a, [&b](const std::string& value) { return b.contains(value); });
}

class Remarks {
 public:
    Remarks(const MachineSet& set, const MachineCells& cells) : set_(set), cells_(cells) {}

    MachineRemarks make() {
        sayMethods();
        saySettings();
        saySuites();
        sayOtherWork();
        sayPrograms();
        sayMixedPrograms();
        sayKinds();
        for (std::size_t folder = 0; folder < set_.folders.size(); ++folder) sayProblems(folder);
        sayInvalid();
        for (const std::string& sentence : cells_.unplaced) result_.notes.push_back(sentence);
        listMissing();
        return std::move(result_);
    }

 private:
    [[nodiscard]] std::size_t sides() const { return set_.sides.size(); }

    /// `320x240 on A and C; 640x480 on B`: machines with equal texts are joined.
    [[nodiscard]] std::string bySide(const std::vector<std::string>& texts) const {
        std::map<std::string, Names> labels;
        for (std::size_t side = 0; side < sides(); ++side)
            if (!texts[side].empty()) labels[texts[side]].push_back(set_.sides[side].label);
        Names parts;
        for (auto& [text, names] : labels) {
            std::ranges::sort(names);
            parts.push_back(fmt::format("{} on {}", text, listOf(names)));
        }
        return fmt::format("{}", fmt::join(parts, "; "));
    }

    [[nodiscard]] Names labelsOf(const std::vector<std::size_t>& chosen) const {
        Names labels;
        for (const std::size_t side : chosen) labels.push_back(set_.sides[side].label);
        std::ranges::sort(labels);
        return labels;
    }

    /// Adds the sentence `THING: only on A`, which also explains its missing cells.
    void sayOnlyOn(const std::string& thing, const std::set<std::size_t>& on) {
        result_.apart.push_back(
            fmt::format("{}: only on {}", thing, listOf(labelsOf(std::vector<std::size_t>(on.begin(), on.end())))));
    }

    /// Notes the folder's problems except differences between machines, which the table of hardware shows.
    void sayProblems(std::size_t folder) {
        const ReportData& data = set_.folders[folder];
        for (const std::string& problem : data.problems)
            if (std::ranges::find(data.mixedMachines, problem) == data.mixedMachines.end())
                result_.notes.push_back(fmt::format("{}: {}", set_.labels[folder], problem));
    }

    void sayMethods() {
        std::map<std::string, std::set<std::size_t>> machines;  // by method
        for (const MachineCell& cell : cells_.cells)
            for (std::size_t side = 0; side < sides(); ++side)
                if (cell.sides[side].count() > 0) machines[suite::valueOf(cell.identity, "method")].insert(side);
        for (const auto& [method, on] : machines)
            if (on.size() < sides()) sayOnlyOn(fmt::format("method {}", method), on);
        methods_ = std::move(machines);
    }

    [[nodiscard]] SideValues valuesByside(const std::string& name) const {
        SideValues values(sides());
        for (const MachineCell& cell : cells_.cells) {
            const bool has =
                std::ranges::find(cell.identity, name, &suite::CellIdentity::value_type::first) != cell.identity.end();
            // A parameter may be missing because the method has none; for other fields, missing is a value.
            if (!has && name.starts_with("p.")) continue;
            for (std::size_t side = 0; side < sides(); ++side)
                if (cell.isDoneOn(side)) values[side].insert(suite::valueOf(cell.identity, name));
        }
        return values;
    }

    void saySettings() {
        for (const std::string& name : cells_.names) {
            SideValues values = valuesByside(name);
            bool isApart = false;
            for (const auto& a : values)
                for (const auto& b : values) isApart = isApart || (!a.empty() && !b.empty() && !haveCommon(a, b));
            if (!isApart) continue;
            std::vector<std::string> texts;
            for (const auto& some : values) texts.push_back(some.empty() ? std::string() : valuesText(some));
            result_.apart.push_back(fmt::format("{}: {}", parameterName(name), bySide(texts)));
            settings_.emplace_back(name, std::move(values));
        }
    }

    void saySuites() {
        std::map<std::string, std::set<std::size_t>> machines;  // by experiment
        for (std::size_t side = 0; side < sides(); ++side)
            for (const RunGroup& group : set_.folders[set_.sides[side].folder].groups)
                for (const ReportCell& cell : group.cells)
                    for (const results::StoredRun* run : cell.done)
                        if (!group.suite.empty() && std::ranges::binary_search(set_.sides[side].runs, run->runId, {},
                                                                               &results::StoredRun::runId)) {
                            machines[group.id].insert(side);
                            groupsOf_[run->runId].insert(group.id);
                        }
        for (const auto& [id, on] : machines)
            if (on.size() < sides()) sayOnlyOn(fmt::format("suite {}", id), on);
        suites_ = std::move(machines);
    }

    void sayOtherWork() {
        std::map<std::string, std::size_t> counts;
        for (const MachineCell& cell : cells_.cells)
            if (!cell.otherWork.empty()) ++counts[cell.otherWork];
        for (const auto& [what, count] : counts)
            result_.apart.push_back(
                fmt::format("{} is not the same everywhere: different work was measured in {} {}, "
                            "whose times are left out",
                            what, count, count == 1 ? "configuration" : "configurations"));
    }

    void sayPrograms() {
        static const std::set<std::string> asked{"dustbench", "commit", "compiler", "flags", "build"};
        for (const HardwareRow& row : hardwareTable(set_)) {
            if (!asked.contains(row.name) || !row.differs()) continue;
            std::vector<std::string> texts;
            texts.reserve(row.values.size());
            for (const std::string& value : row.values) texts.push_back(value.empty() ? "unknown" : value);
            result_.programs.push_back(fmt::format("{}: {}", row.name, bySide(texts)));
        }
    }

    /// Notes machines whose runs were measured by different programs.
    void sayMixedPrograms() {
        for (const MachineSide& side : set_.sides)
            for (const char* field : {"git_commit", "compiler", "gl_version"})
                if (const auto found = side.facts.find(field); found != side.facts.end() && found->second.size() > 1)
                    result_.notes.push_back(
                        fmt::format("{}: its runs differ in {}: {}", side.label, field, valuesText(found->second)));
    }

    void sayInvalid() {
        for (const MachineSide& side : set_.sides) {
            std::vector<const results::StoredRun*> done;
            for (const results::StoredRun* run : side.runs)
                if (run->status == results::RunStatus::done) done.push_back(run);
            if (const std::string said = results::saysInvalid(done); !said.empty())
                result_.notes.push_back(fmt::format("{}: {}", side.label, said));
        }
    }

    void sayKinds() {
        for (std::size_t a = 0; a < sides(); ++a)
            for (std::size_t b = a + 1; b < sides(); ++b)
                if (areAlike(set_.sides[a], set_.sides[b]))
                    result_.notes.push_back(fmt::format(
                        "{} are the same machine, or two identical ones: CPU, cores, memory and graphics are equal",
                        listOf(labelsOf({a, b}))));
        std::vector<std::string> kinds, threads;
        for (const MachineSide& side : set_.sides) {
            kinds.emplace_back(isSoftware(side) ? "a software renderer" : "a GPU");
            std::set<std::string> counts;
            for (const results::StoredRun* run : side.runs)
                if (const auto found = run->cells.find("threads");
                    run->status == results::RunStatus::done && found != run->cells.end() && !found->second.empty())
                    counts.insert(found->second);
            threads.push_back(counts.empty() ? "" : valuesText(counts));
        }
        if (std::ranges::any_of(kinds, [&](const std::string& kind) { return kind != kinds.front(); }))
            result_.notes.push_back(
                fmt::format("drawn by {}: drawing takes a different share of a frame", bySide(kinds)));
        if (std::ranges::any_of(threads, [&](const std::string& count) { return count != threads.front(); }))
            result_.notes.push_back(fmt::format("CPU threads of a run: {}", bySide(threads)));
        for (std::size_t side = 0; side < sides(); ++side) {
            const bool isShared = std::ranges::any_of(
                cells_.cells, [side](const MachineCell& cell) { return cell.isDoneOn(side) && cell.sidesDone() > 1; });
            if (!isShared)
                result_.notes.push_back(fmt::format("{}: none of its configurations was measured on another machine",
                                                    set_.sides[side].label));
        }
    }

    /// True if another sentence already explains why the cell is missing on a machine.
    [[nodiscard]] bool isExplained(const MachineCell& cell, std::size_t side) const {
        if (!methods_.at(suite::valueOf(cell.identity, "method")).contains(side)) return true;
        for (const auto& [name, values] : settings_)
            if (!values[side].empty() && !values[side].contains(suite::valueOf(cell.identity, name))) return true;
        std::set<std::string> suites;
        for (const suite::CellRuns& runs : cell.sides)
            for (const results::StoredRun* run : runs.done)
                if (const auto found = groupsOf_.find(run->runId); found != groupsOf_.end())
                    suites.insert(found->second.begin(), found->second.end());
        return !suites.empty() &&
               std::ranges::none_of(suites, [&](const std::string& suite) { return suites_.at(suite).contains(side); });
    }

    void listMissing() {
        for (const MachineCell& cell : cells_.cells) {
            MissingCell missing{cells_.labelOf(cell), {}, {}};
            for (std::size_t side = 0; side < sides(); ++side) {
                const suite::CellRuns& runs = cell.sides[side];
                if (!runs.done.empty())
                    missing.on.push_back(side);
                else if (!runs.invalid.empty())
                    missing.lacking.emplace_back(side, "invalid: " + results::whyInvalid(*runs.invalid.front()));
                else if (!runs.copied.empty())
                    missing.lacking.emplace_back(side, "copied from another folder");
                else if (!runs.failed.empty())
                    missing.lacking.emplace_back(side, "failed: " + runs.failed.front()->reason);
                else if (!runs.skipped.empty())
                    missing.lacking.emplace_back(side, "skipped: " + runs.skipped.front()->reason);
                else if (!isExplained(cell, side))
                    missing.lacking.emplace_back(side, "not measured");
            }
            if (!missing.on.empty() && !missing.lacking.empty()) result_.missing.push_back(std::move(missing));
        }
    }

    const MachineSet& set_;
    const MachineCells& cells_;
    MachineRemarks result_;
    std::map<std::string, std::set<std::size_t>> methods_, suites_;  ///< the machines with any of their runs
    std::map<std::string, std::set<std::string>> groupsOf_;          ///< by run id
    std::vector<std::pair<std::string, SideValues>> settings_;       ///< settings without common values
};

}  // namespace

MachineRemarks remarksOn(const MachineSet& set, const MachineCells& cells) {
    return Remarks(set, cells).make();
}

}  // namespace dustbench::report
