#include "bench/recommend/measured_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "bench/results/compared_runs.h"
#include "bench/results/results_folder.h"
#include "bench/results/stored_run.h"
#include "bench/results/summary.h"
#include "bench/suite/suite_cells.h"
#include "methods/contract/errors.h"

namespace dustbench::recommend {
namespace {

namespace fs = std::filesystem;
using files::CsvTable;
using files::numberOf;

constexpr std::array<std::string_view, 5> neededColumns{"run_id", "status", "method", "scene", "seed"};
constexpr std::array<std::string_view, 4> conductColumns{"sync", "threads", "frames", "dust_on"};
/// Settings of a world that summary.csv lacks, by their names in a run's key.
constexpr std::array<std::string_view, 3> worldOfKey{"camera_path", "dust", "dust_columns"};

std::string cellOf(const CsvTable& table, std::size_t row, std::string_view column) {
    return table.hasColumn(column) ? table.cell(row, column) : std::string();
}

void readSettings(const CsvTable& table, std::size_t row, MeasuredRun& run) {
    run.world = {{"scene", cellOf(table, row, "scene")},
                 {"drive", cellOf(table, row, "drive")},
                 {"size", cellOf(table, row, "width") + "x" + cellOf(table, row, "height")}};
    for (const std::string_view column : conductColumns) run.conduct.emplace(column, cellOf(table, row, column));
    for (const std::string& column : table.header()) {
        if (!column.starts_with("p.")) continue;
        const std::string name = column.substr(2), &value = table.cell(row, column);
        // Empty: the method has no such parameter, or `at` changes nothing.
        if (!value.empty()) (suite::isOfTheWorld(name) ? run.world : run.own)[name] = value;
    }
}

void readNumbers(const CsvTable& table, std::size_t row, MeasuredRun& run) {
    for (const std::string& column : results::numericColumns())
        if (const auto value = numberOf(cellOf(table, row, column))) run.numbers[column] = *value;
    // An RMSE but no PSNR: the pictures are identical within the mask, so the PSNR is infinite.
    if (table.hasColumn("psnr_mask_db") && run.numbers.contains("rmse_linear_mask"))
        run.numbers.emplace("psnr_mask_db", identicalDb);
}

MeasuredRun runOf(const CsvTable& table, std::size_t row) {
    MeasuredRun run{.runId = table.cell(row, "run_id"),
                    .method = table.cell(row, "method"),
                    .seed = table.cell(row, "seed"),
                    .reference = cellOf(table, row, "metric_reference")};
    if (!run.reference.empty() && run.reference != "exact") run.reference = run.method + " " + run.reference;
    readSettings(table, row, run);
    readNumbers(table, row, run);
    return run;
}

std::size_t machineOf(std::vector<MachineFacts>& machines, const results::StoredRun& run) {
    MachineFacts machine;
    for (const std::string_view field : results::machineFields())
        if (const auto found = run.provenance.find(field); found != run.provenance.end())
            machine.fields.emplace(field, found->second);
    auto known = std::ranges::find(machines, machine.fields, &MachineFacts::fields);
    if (known == machines.end()) known = machines.insert(machines.end(), machine);
    if (const auto commit = run.provenance.find("git_commit"); commit != run.provenance.end())
        known->commits.insert(commit->second);
    return static_cast<std::size_t>(known - machines.begin());
}

void addProvenance(MeasuredRuns& measured, const results::StoredRuns& stored) {
    measured.machines.clear();
    for (MeasuredRun& run : measured.runs) {
        const results::StoredRun& from = stored.at(run.runId);
        run.machine = machineOf(measured.machines, from);
        for (const auto& [name, value] : results::keyFields(from))
            if (std::ranges::find(worldOfKey, name) != worldOfKey.end() && !value.empty()) run.world[name] = value;
    }
    if (measured.machines.empty()) measured.machines.emplace_back();
}

/// Reads a machine.csv: a table with one row, as in reports/sample.
MachineFacts machineOf(const CsvTable& table) {
    MachineFacts machine;
    if (table.rows() == 0) return machine;
    for (const std::string& column : table.header()) machine.fields.emplace(column, table.cell(0, column));
    if (const auto commit = machine.fields.extract("git_commit")) machine.commits.insert(commit.mapped());
    return machine;
}

std::string valueOf(const MeasuredRun& run, const std::string& key) {
    if (key == "method") return run.method;
    if (key == "seed") return run.seed;
    for (const SettingTexts* settings : {&run.world, &run.own, &run.conduct})
        if (const auto found = settings->find(key); found != settings->end()) return found->second;
    return "";
}

std::vector<std::string> keysOf(const MeasuredRuns& runs) {
    std::set<std::string> keys{"method", "seed"};
    for (const MeasuredRun& run : runs.runs)
        for (const SettingTexts* settings : {&run.world, &run.own, &run.conduct})
            for (const auto& [key, value] : *settings) keys.insert(key);
    return {keys.begin(), keys.end()};
}

bool sameValue(const std::string& a, const std::string& b) {
    if (a == b) return true;
    const auto x = numberOf(a), y = numberOf(b);
    return x && y && *x == *y;
}

void keepOnly(MeasuredRuns& runs, const Condition& condition, const std::vector<std::string>& keys) {
    const bool isKnown = std::ranges::find(keys, condition.key) != keys.end();
    if (!isKnown && condition.option == "--" + condition.key)
        throw InputError(fmt::format("{}: got '{}', but '{}' has no setting '{}'", condition.option,
                                     fmt::join(condition.values, ","), runs.from, condition.key));
    if (!isKnown)
        throw InputError(fmt::format("{}: {}", condition.option, unknownName("setting", condition.key, keys).what()));
    std::set<std::string> values;
    const std::size_t erased = std::erase_if(runs.runs, [&](const MeasuredRun& run) {
        const std::string value = valueOf(run, condition.key);
        if (!value.empty()) values.insert(value);
        return std::ranges::none_of(condition.values,
                                    [&value](const std::string& wanted) { return sameValue(value, wanted); });
    });
    if (erased > 0 && runs.runs.empty())
        throw InputError(fmt::format("{}: got {}={}, allowed: measured values: {}", condition.option, condition.key,
                                     fmt::join(condition.values, ","), fmt::join(values, ", ")));
}

/// A concatenated table may contain a run several times, but only with equal rows. It counts once.
void requireEqualRows(const CsvTable& table, std::size_t first, std::size_t second, const std::string& from) {
    for (const std::string& column : table.header())
        if (table.cell(first, column) != table.cell(second, column))
            throw InputError(fmt::format("'{}': got two different rows of the run '{}', allowed: one", from,
                                         table.cell(first, "run_id")));
}

}  // namespace

MeasuredRuns measuredRuns(const CsvTable& table, const std::string& from) {
    for (const std::string_view column : neededColumns)
        if (!table.hasColumn(column))
            throw InputError(fmt::format("'{}': has no column '{}', expected a summary.csv", from, column));
    MeasuredRuns measured{.from = from, .machines = std::vector<MachineFacts>(1)};
    std::map<std::string, std::size_t> rowOf;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (const auto [first, isNew] = rowOf.emplace(table.cell(row, "run_id"), row); !isNew) {
            requireEqualRows(table, first->second, row, from);
            continue;
        }
        if (table.cell(row, "status") != "done") {
            ++measured.notDone;
        } else if (const std::string why = cellOf(table, row, "invalid"); !why.empty()) {
            ++measured.invalid;
            ++measured.whyInvalid[why];
        } else if (table.cell(row, "method") != results::baselineMethod) {  // which draws nothing
            measured.runs.push_back(runOf(table, row));
        }
    }
    return measured;
}

MeasuredRuns readMeasuredRuns(const fs::path& from) {
    std::error_code error;
    if (fs::is_directory(from / "runs", error)) {
        const results::StoredRuns stored = results::readStoredRuns(from);
        MeasuredRuns measured = measuredRuns(
            CsvTable::parseText(results::summaryCsv(stored), (from / "summary.csv").string()), from.string());
        addProvenance(measured, stored);
        return measured;
    }
    const fs::path file = fs::is_directory(from, error) ? from / "summary.csv" : from;
    if (!fs::is_regular_file(file, error))
        throw InputError(fmt::format(
            "'{}': contains no results, expected a summary.csv or a folder written by `suite`, `compare` or "
            "`reproduce`",
            from.string()));
    MeasuredRuns measured = measuredRuns(CsvTable::parseFile(file), from.string());
    if (const fs::path machine = file.parent_path() / "machine.csv"; fs::is_regular_file(machine, error))
        measured.machines.front() = machineOf(CsvTable::parseFile(machine));
    return measured;
}

void narrow(MeasuredRuns& runs, const std::vector<Condition>& conditions) {
    const std::vector<std::string> keys = keysOf(runs);
    for (const Condition& condition : conditions) keepOnly(runs, condition, keys);
}

}  // namespace dustbench::recommend
