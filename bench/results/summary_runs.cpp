#include "bench/results/summary_runs.h"

#include <fmt/format.h>

#include "bench/results/run_table.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

namespace fs = std::filesystem;

StoredRun runOfRow(const files::CsvTable& table, std::size_t row) {
    StoredRun run;
    run.runId = table.cell(row, "run_id");
    if (run.runId.empty()) throw InputError(table.where(row) + "run_id: got '', expected the name of a run");
    run.status = runStatuses.parse(table.where(row) + "status", table.cell(row, "status"));
    run.reason = table.cell(row, "reason");
    for (const std::string& column : table.header()) {
        const std::string& text = table.cell(row, column);
        if (text.empty()) continue;
        if (column.starts_with("p."))
            run.parameters[column.substr(2)] = text;
        else
            run.cells[column] = text;
    }
    try {
        requireSoundCells(run);
    } catch (const InputError& error) {
        throw InputError(table.where(row) + error.what());
    }
    return run;
}

}  // namespace

bool holdsTablesAlone(const fs::path& folder) {
    std::error_code none;
    return !fs::exists(folder / "runs", none) && fs::is_regular_file(folder / "summary.csv", none);
}

StoredRuns readSummaryRuns(const fs::path& folder, std::vector<std::string>& problems) {
    std::map<std::string, std::string, std::less<>> machine;
    if (std::error_code none; fs::exists(folder / "machine.csv", none)) {
        const auto table = files::CsvTable::parseFile(folder / "machine.csv");
        if (table.rows() > 0)
            for (const std::string& column : table.header()) machine[column] = table.cell(0, column);
    }
    const auto table = files::CsvTable::parseFile(folder / "summary.csv");
    StoredRuns runs;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        try {
            StoredRun run = runOfRow(table, row);
            run.provenance = machine;
            const std::string id = run.runId;
            if (!runs.emplace(id, std::move(run)).second)
                throw InputError(fmt::format("{}run_id: '{}' appears twice", table.where(row), id.substr(0, 80)));
        } catch (const InputError& fault) {
            problems.push_back(fmt::format("left out: {}", fault.what()));
        }
    }
    addRunTable(folder, runs, problems);
    return runs;
}

}  // namespace dustbench::bench
