#include "bench/report/run_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "bench/report/report_files.h"
#include "bench/suite/catalogue.h"
#include "bench/suite/suite.h"
#include "bench/suite/suite_cells.h"
#include "bench/suite/suite_evaluation.h"
#include "bench/suite/suite_plan.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::report {
namespace {

using files::numberOf;

using Settings = std::map<std::string, std::string, std::less<>>;

/// Columns of summary.csv that describe the world and the run; `size` replaces width and height.
constexpr std::array<std::string_view, 7> worldCells{"scene", "drive", "seed", "sync", "threads", "frames", "dust_on"};
/// Columns whose growth with a load is fitted.
constexpr std::array<std::string_view, 3> fittedColumns{"frame_ms_median", "build_ms_median", "sort_ms_median"};

const std::string& cellOf(const results::StoredRun& run, std::string_view column) {
    static const std::string none;
    const auto found = run.cells.find(column);
    return found == run.cells.end() ? none : found->second;
}

/// Everything that can distinguish two cells, except method and machine.
Settings settingsOf(const results::StoredRun& run) {
    Settings settings(run.parameters.begin(), run.parameters.end());
    // A run that failed early has no frames and a skipped one no drive, but they still belong to the same cell.
    for (const std::string_view column : worldCells)
        if (run.status == results::RunStatus::done || (column != "frames" && !cellOf(run, column).empty()))
            settings.emplace(column, cellOf(run, column));
    if (!cellOf(run, "width").empty()) settings["size"] = cellOf(run, "width") + "x" + cellOf(run, "height");
    return settings;
}

bool isWorld(std::string_view name) {
    return name == "size" || std::ranges::find(worldCells, name) != worldCells.end() || suite::isOfTheWorld(name);
}

void describe(ReportAxis& axis, const std::set<std::string>& methods) {
    std::vector<Parameter> declared = suite::worldParameterList();
    for (const suite::CatalogueItem& item : suite::catalogue("methods"))
        if (methods.contains(item.id)) std::ranges::copy(item.parameters, std::back_inserter(declared));
    const auto found = std::ranges::find(declared, axis.name, &Parameter::name);
    if (found == declared.end()) return;
    axis.unit = found->unit;
    axis.help = found->help;
}

/// Numerically if all values are numbers, otherwise by name.
void sortValues(ReportAxis& axis) {
    axis.numeric =
        std::ranges::all_of(axis.values, [](const std::string& value) { return numberOf(value).has_value(); });
    std::ranges::sort(axis.values, [&axis](const std::string& a, const std::string& b) {
        return axis.numeric ? *numberOf(a) < *numberOf(b) : a < b;
    });
}

/// World settings that vary, and method settings that vary between runs of the same method. Settings that only differ
/// between methods are part of the setup.
std::vector<ReportAxis> axesOf(const std::vector<const results::StoredRun*>& runs) {
    std::map<std::string, std::map<std::string, std::set<std::string>>> valuesByMethod;  // by name, then method
    std::set<std::string> methods;
    for (const results::StoredRun* run : runs)
        for (const auto& [name, value] : settingsOf(*run)) {
            valuesByMethod[name][isWorld(name) ? std::string() : cellOf(*run, "method")].insert(value);
            methods.insert(cellOf(*run, "method"));
        }
    std::vector<ReportAxis> axes;
    for (const auto& [name, byMethod] : valuesByMethod) {
        if (std::ranges::none_of(byMethod, [](const auto& entry) { return entry.second.size() > 1; })) continue;
        ReportAxis axis;
        axis.name = name;
        axis.world = isWorld(name);
        std::set<std::string> values;
        for (const auto& [method, some] : byMethod) values.insert(some.begin(), some.end());
        axis.values.assign(values.begin(), values.end());
        sortValues(axis);
        describe(axis, methods);
        axes.push_back(std::move(axis));
    }
    return axes;
}

/// The settings of the world that are the same in all runs that have them.
Settings commonOf(const std::vector<const results::StoredRun*>& runs) {
    std::map<std::string, std::set<std::string>> values;
    for (const results::StoredRun* run : runs)
        if (run->status == results::RunStatus::done)
            for (const auto& [name, value] : settingsOf(*run))
                if (isWorld(name) && !value.empty()) values[name].insert(value);
    Settings common;
    for (const auto& [name, some] : values)
        if (some.size() == 1) common.emplace(name, *some.begin());
    return common;
}

void fitCurves(RunGroup& group) {
    constexpr std::size_t minimumLoads = 4;
    for (const ReportAxis& axis : group.axes) {
        if (!axis.numeric || axis.name == "seed" || axis.values.size() < minimumLoads) continue;
        std::map<std::tuple<std::string, Settings, std::size_t>, std::vector<const ReportCell*>> curves;
        for (const ReportCell& cell : group.cells) {
            Settings rest = cell.settings;
            if (rest.erase(axis.name) > 0) curves[{cell.method, rest, cell.machine}].push_back(&cell);
        }
        for (const auto& [key, cells] : curves)
            for (const std::string_view column : fittedColumns) {
                std::vector<measure::CostPoint> points;
                for (const ReportCell* cell : cells)
                    for (const double ms : suite::numbersIn(suite::validOf(cell->done), column))
                        points.push_back({*numberOf(cell->settings.at(axis.name)), ms});
                const measure::CostFit fit = measure::fitCost(points);
                if (!fit.reason.empty()) continue;
                const auto& [method, rest, machine] = key;
                group.fits.push_back({axis.name, std::string(column), method, rest, machine, fit});
            }
    }
}

std::string labelOf(const RunGroup& group, const ReportCell& cell, bool world) {
    std::string label;
    for (const ReportAxis& axis : group.axes) {
        const auto found = cell.settings.find(axis.name);
        if (axis.world == world && found != cell.settings.end() && !found->second.empty())
            label += fmt::format("{}{}={}", label.empty() ? "" : " ", axis.name, found->second);
    }
    return label;
}

/// Finds the runs of suites in results.
class RunFinder {
 public:
    RunFinder(const results::StoredRuns& runs, int repetitions) : runs_(runs), repetitions_(repetitions) {
        for (const auto& [id, run] : runs) methods_.insert(cellOf(run, "method"));
    }

    /// The existing runs of the suite, full or quick.
    [[nodiscard]] std::vector<const results::StoredRun*> of(const suite::Suite& suite) const {
        std::vector<const results::StoredRun*> found;
        for (const suite::PlannedRun& cell : suite.cells) {
            if (!methods_.contains(cell.spec.method)) continue;  // saves the hash in its id
            for (int repetition = 1; repetition <= repetitions_; ++repetition)
                if (const auto run = runs_.find(results::runId(suite::inRepetition(cell.spec, repetition)));
                    run != runs_.end())
                    found.push_back(&run->second);
        }
        return found;
    }

 private:
    const results::StoredRuns& runs_;
    int repetitions_;
    std::set<std::string> methods_;
};

/// Fills in the suite's description and its verdicts on the runs.
void describeBy(suite::Suite suite, int repetitions, const results::StoredRuns& runs, RunGroup& group) {
    suite.repetitions = std::max(suite.repetitions, repetitions);
    group.suite = suite.id;
    group.title = suite.title.empty() ? suite.id : suite.title;
    group.summary = suite.summary;
    group.chart = suite.chart;
    group.comparisons = suite::suiteVerdicts(suite, runs);
}

}  // namespace

std::string variantLabel(const RunGroup& group, const ReportCell& cell) {
    const std::string own = labelOf(group, cell, false);
    return own.empty() ? cell.method : cell.method + " " + own;
}

std::string worldLabel(const RunGroup& group, const ReportCell& cell) {
    return labelOf(group, cell, true);
}

RunGroup makeGroup(const std::vector<const results::StoredRun*>& runs, const MachineOfRun& machines) {
    static const std::vector<std::string> columns = suite::chartColumns();
    RunGroup group;
    group.axes = axesOf(runs);
    group.common = commonOf(runs);
    std::map<std::tuple<std::string, Settings, std::size_t>, ReportCell> cells;
    for (const results::StoredRun* run : runs) {
        const Settings all = settingsOf(*run);
        Settings settings;
        for (const ReportAxis& axis : group.axes)
            if (const auto found = all.find(axis.name); found != all.end()) settings.insert(*found);
        const auto machine = machines.find(run->runId);
        const std::size_t index = machine == machines.end() ? 0 : machine->second;
        ReportCell& cell = cells[{cellOf(*run, "method"), settings, index}];
        cell.method = cellOf(*run, "method");
        cell.settings = settings;
        cell.machine = index;
        if (run->status == results::RunStatus::done)
            cell.done.push_back(run);
        else
            ++cell.failed;
    }
    for (auto& [key, cell] : cells) {
        std::ranges::sort(cell.done, {}, [](const results::StoredRun* run) {
            return std::pair(numberOf(cellOf(*run, "repetition")).value_or(0), run->runId);
        });
        for (const std::string& column : columns)
            if (std::vector<double> values = suite::numbersIn(cell.done, column); !values.empty())
                cell.values[column] = medianInterval(std::move(values));
        group.cells.push_back(std::move(cell));
    }
    fitCurves(group);
    return group;
}

std::vector<RunGroup> sortIntoGroups(const results::StoredRuns& runs, const MachineOfRun& machines,
                                     std::vector<std::string>& problems) {
    int repetitions = 1;
    for (const auto& [id, run] : runs)
        repetitions = std::max(repetitions, static_cast<int>(suite::numberIn(run, "repetition").value_or(1)));

    const RunFinder finder(runs, repetitions);
    std::vector<RunGroup> groups;
    std::set<const results::StoredRun*> placed;
    std::vector<std::string> faults;
    for (const suite::SuiteFile& file : suite::listSuites()) {
        std::set<const results::StoredRun*> shown;  // of this suite
        const auto add = [&](suite::Suite suite, const std::string& id) {
            const std::vector<const results::StoredRun*> found = finder.of(suite);
            // Runs that belong to both forms of the suite are shown once.
            if (std::ranges::all_of(found, [&](const results::StoredRun* run) { return shown.contains(run); })) return;
            shown.insert(found.begin(), found.end());
            const std::vector<const results::StoredRun*> all = finder.of(suite::withBaselines(suite));
            placed.insert(all.begin(), all.end());
            RunGroup group = makeGroup(found, machines);
            group.id = id;
            group.paper = file.paper;
            describeBy(std::move(suite), repetitions, runs, group);
            group.suiteText = fileText(file.file);
            groups.push_back(std::move(group));
        };
        try {
            suite::SuiteForms forms = suite::loadForms(file.file.string());
            add(std::move(forms.full), file.id);
            if (forms.quick) add(std::move(*forms.quick), file.id + "-quick");
        } catch (const InputError& error) {
            faults.push_back(fmt::format("suite '{}' cannot be read: {}", file.id, error.what()));
        }
    }
    std::vector<const results::StoredRun*> others;
    for (const auto& [id, run] : runs)
        if (!placed.contains(&run)) others.push_back(&run);
    if (!others.empty()) {
        // They may belong to one of the unreadable suites.
        std::ranges::move(faults, std::back_inserter(problems));
        RunGroup group = makeGroup(others, machines);
        group.id = "other";
        group.title = groups.empty() ? "Runs" : "Other runs";
        group.summary = "Runs that belong to no suite of the data folder.";
        groups.push_back(std::move(group));
    }
    return groups;
}

}  // namespace dustbench::report
