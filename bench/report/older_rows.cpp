#include "bench/report/older_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "bench/results/run_spec.h"
#include "bench/suite/suite.h"
#include "bench/suite/suite_plan.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/csv.h"

namespace dustbench::report {
namespace {

/// Planned runs of suites by a key that can also be made from a row.
using PlannedByKey = std::map<std::string, std::map<std::string, results::RunSpec>>;

std::string keyOfSpec(const results::RunSpec& spec) {
    return fmt::format("{}\n{}\n{}\n{}\n{}\n{}", spec.method, spec.scene, spec.size.width, spec.size.height, spec.seed,
                       spec.repetition);
}

std::string cellIn(const results::StoredRun& run, std::string_view column) {
    const auto found = run.cells.find(column);
    return found == run.cells.end() ? std::string() : found->second;
}

std::string keyOfRow(const results::StoredRun& run) {
    return fmt::format("{}\n{}\n{}\n{}\n{}\n{}", cellIn(run, "method"), cellIn(run, "scene"), cellIn(run, "width"),
                       cellIn(run, "height"), cellIn(run, "seed"), cellIn(run, "repetition"));
}

bool isEqual(const std::string& a, const std::string& b) {
    const std::optional<double> x = files::numberOf(a), y = files::numberOf(b);
    return a == b || (x && y && *x == *y);
}

/// Whether the row lacks a parameter that its method has today.
bool isOlder(const results::StoredRun& run) {
    const auto method = std::ranges::find(methods(), cellIn(run, "method"), &MethodInfo::id);
    return method != methods().end() &&
           std::ranges::any_of(results::canonicalParameters(*method, {}), [&](const auto& parameter) {
               return !parameter.second.empty() && !results::isLaterDefault(parameter.first, parameter.second) &&
                      !run.parameters.contains(parameter.first);
           });
}

/// The runs of all suites of this build that have the key of a row.
PlannedByKey plannedRuns(const results::StoredRuns& runs) {
    PlannedByKey planned;
    int repetitions = 1;
    for (const auto& [id, run] : runs) {
        planned[keyOfRow(run)];
        repetitions = std::max(repetitions, static_cast<int>(files::numberOf(cellIn(run, "repetition")).value_or(1)));
    }
    const auto add = [&](const suite::Suite& suite) {
        for (const suite::PlannedRun& cell : suite::withBaselines(suite).cells)
            for (int repetition = 1; repetition <= repetitions; ++repetition) {
                results::RunSpec spec = suite::inRepetition(cell.spec, repetition);
                if (const auto found = planned.find(keyOfSpec(spec)); found != planned.end())
                    found->second.try_emplace(results::runId(spec), spec);
            }
    };
    for (const suite::SuiteFile& file : suite::listSuites()) {
        try {
            const suite::SuiteForms forms = suite::loadForms(file.file.string());
            add(forms.full);
            if (forms.quick) add(*forms.quick);
        } catch (const InputError&) {  // which sortIntoGroups reports
        }
    }
    return planned;
}

/// The parameters that are missing in the row; nullopt if the row is not the planned run.
std::optional<std::set<std::string>> missingIn(const results::StoredRun& run, const results::RunSpec& spec) {
    const auto differs = [&run](std::string_view column, const std::string& wanted) {
        const std::string said = cellIn(run, column);
        return !wanted.empty() && !said.empty() && !isEqual(said, wanted);
    };
    if (differs("drive", spec.drive) || differs("sync", std::string(results::syncs.wordOf(spec.sync))) ||
        differs("frames", std::to_string(spec.frames)))
        return std::nullopt;
    for (const auto& [name, value] : run.parameters)
        if (const auto found = spec.parameters.find(name);
            found == spec.parameters.end() || !isEqual(found->second, value))
            return std::nullopt;
    std::set<std::string> missing;
    for (const auto& [name, value] : spec.parameters)
        if (!value.empty() && !run.parameters.contains(name)) missing.insert(name);
    if (missing.empty()) return missing;
    const results::ParameterTexts defaults = results::canonicalParameters(findMethod(spec.method), {});
    const bool isDefault = std::ranges::all_of(
        missing, [&](const std::string& name) { return defaults.at(name) == spec.parameters.at(name); });
    return isDefault ? std::optional(missing) : std::nullopt;
}

}  // namespace

void adoptOlderRows(results::StoredRuns& runs, std::vector<std::string>& problems) {
    if (std::ranges::none_of(runs, [](const auto& entry) { return isOlder(entry.second); })) return;
    const PlannedByKey planned = plannedRuns(runs);
    std::set<std::string> added, taken;
    std::vector<std::pair<std::string, std::string>> renamed;
    for (const auto& [id, run] : runs) {
        const std::map<std::string, results::RunSpec>& candidates = planned.at(keyOfRow(run));
        if (candidates.contains(id)) continue;
        std::set<std::string> fitting, missing;
        for (const auto& [plannedId, spec] : candidates)
            if (const auto lacks = missingIn(run, spec)) {
                fitting.insert(plannedId);
                missing = *lacks;
            }
        // If the row fits two planned runs that differ only in missing parameters, it cannot be assigned.
        if (fitting.size() != 1 || missing.empty() || runs.contains(*fitting.begin()) ||
            !taken.insert(*fitting.begin()).second)
            continue;
        renamed.emplace_back(id, *fitting.begin());
        added.merge(missing);
    }
    for (const auto& [from, to] : renamed) {
        auto node = runs.extract(from);
        node.key() = to;
        node.mapped().runId = to;
        runs.insert(std::move(node));
    }
    if (!renamed.empty())
        problems.push_back(
            fmt::format("{} of {} runs are from an older build without the parameters {}: the report assumes "
                        "their defaults",
                        renamed.size(), runs.size(), fmt::join(added, ", ")));
}

}  // namespace dustbench::report
