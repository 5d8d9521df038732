#include "bench/suite/suite_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "bench/world/world.h"
#include "methods/kit/files/csv.h"

namespace dustbench::suite {
namespace {

Axis parameterAxis(const std::string& name) {
    return {name, [name](const results::RunSpec& spec) {
                const auto found = spec.parameters.find(name);
                return found == spec.parameters.end() ? std::string() : found->second;
            }};
}

std::set<std::string> parameterNames(std::span<const PlannedRun* const> cells) {
    std::set<std::string> names;
    for (const PlannedRun* cell : cells)
        for (const auto& [name, text] : cell->spec.parameters) names.insert(name);
    return names;
}

}  // namespace

std::string worldKey(const results::RunSpec& spec) {
    std::string key =
        fmt::format("{}\n{}\n{}x{}\n{}\n", spec.scene, spec.drive, spec.size.width, spec.size.height, spec.seed);
    for (const auto& [name, text] : spec.parameters)
        if (isOfTheWorld(name)) key += fmt::format("{}={}\n", name, text);
    if (!spec.dust.empty()) key += fmt::format("dust={}\n{}\n", spec.dust, spec.dustColumns);
    return key;
}

bool isOfTheWorld(std::string_view parameter) {
    return world::worldParameters().find(parameter) != nullptr;
}

std::vector<Axis> worldAxes(std::span<const PlannedRun* const> cells) {
    std::vector<Axis> axes{
        {"scene", [](const results::RunSpec& spec) { return spec.scene; }},
        {"drive", [](const results::RunSpec& spec) { return spec.drive; }},
        {"size", [](const results::RunSpec& spec) { return fmt::format("{}x{}", spec.size.width, spec.size.height); }},
        {"seed", [](const results::RunSpec& spec) { return fmt::format("{}", spec.seed); }}};
    for (const std::string& name : parameterNames(cells))
        if (isOfTheWorld(name)) axes.push_back(parameterAxis(name));
    std::erase_if(axes, [cells](const Axis& axis) {
        return std::ranges::all_of(
            cells, [&](const PlannedRun* cell) { return axis.of(cell->spec) == axis.of(cells.front()->spec); });
    });
    return axes;
}

std::vector<Axis> methodAxes(std::span<const PlannedRun* const> cells) {
    std::vector<Axis> axes;
    for (const std::string& name : parameterNames(cells)) {
        if (isOfTheWorld(name)) continue;
        Axis axis = parameterAxis(name);
        std::map<std::string, std::set<std::string>> valuesByMethod;
        for (const PlannedRun* cell : cells) valuesByMethod[cell->spec.method].insert(axis.of(cell->spec));
        if (std::ranges::any_of(valuesByMethod, [](const auto& entry) { return entry.second.size() > 1; }))
            axes.push_back(std::move(axis));
    }
    return axes;
}

std::string labelOf(const std::vector<Axis>& axes, const results::RunSpec& spec) {
    std::string label;
    for (const Axis& axis : axes)
        if (const std::string value = axis.of(spec); !value.empty())
            label += (label.empty() ? "" : " ") + axis.name + "=" + value;
    return label;
}

std::vector<const PlannedRun*> cellsOf(const Suite& suite) {
    std::vector<const PlannedRun*> cells;
    cells.reserve(suite.cells.size());
    for (const PlannedRun& cell : suite.cells) cells.push_back(&cell);
    return cells;
}

const results::StoredRun* doneRun(const PlannedRun& cell, int repetition, const results::StoredRuns& runs) {
    const auto found = runs.find(results::runId(inRepetition(cell.spec, repetition)));
    return found != runs.end() && found->second.status == results::RunStatus::done ? &found->second : nullptr;
}

std::vector<const results::StoredRun*> doneRuns(const PlannedRun& cell, int repetitions,
                                                const results::StoredRuns& runs) {
    std::vector<const results::StoredRun*> done;
    for (int repetition = 1; repetition <= repetitions; ++repetition)
        if (const results::StoredRun* run = doneRun(cell, repetition, runs)) done.push_back(run);
    return done;
}

const results::StoredRun* validRun(const PlannedRun& cell, int repetition, const results::StoredRuns& runs) {
    const results::StoredRun* run = doneRun(cell, repetition, runs);
    return run && results::whyInvalid(*run).empty() ? run : nullptr;
}

std::vector<const results::StoredRun*> validOf(std::vector<const results::StoredRun*> done) {
    std::erase_if(done, [](const results::StoredRun* run) { return !results::whyInvalid(*run).empty(); });
    return done;
}

std::optional<double> numberIn(const results::StoredRun& run, std::string_view column) {
    const auto found = run.cells.find(column);
    return found == run.cells.end() ? std::nullopt : files::numberOf(found->second);
}

std::vector<double> numbersIn(const std::vector<const results::StoredRun*>& runs, std::string_view column) {
    std::vector<double> numbers;
    for (const results::StoredRun* run : runs)
        if (const auto number = numberIn(*run, column)) numbers.push_back(*number);
    return numbers;
}

}  // namespace dustbench::suite
