#include "bench/results/run_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <sstream>
#include <string_view>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::results {
namespace fs = std::filesystem;
namespace {

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

std::string fieldOf(const StoredRun& run, std::string_view field) {
    const auto found = run.provenance.find(field);
    return found == run.provenance.end() ? std::string() : found->second;
}

constexpr const char* runTable = "runs.csv";

std::vector<std::string> linesOf(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
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

std::string machineCsv(const StoredRuns& runs) {
    constexpr std::array<std::string_view, 19> fields{
        "cpu",       "cores",      "ram_bytes",   "governor",   "virtual_machine", "kernel",  "gl_renderer",
        "gl_vendor", "gl_version", "gl_platform", "adapter",    "gpu_timers",      "version", "git_commit",
        "git_dirty", "compiler",   "flags",       "build_type", "started_utc"};
    const StoredRun* first = nullptr;
    for (const auto& [id, run] : runs)
        if (run.status == RunStatus::done && (!first || fieldOf(run, "started_utc") < fieldOf(*first, "started_utc")))
            first = &run;
    if (!first) throw InputError("machine.csv: no run is done");
    std::string header, row;
    for (const std::string_view field : fields) {
        header.append(field).append(1, ',');
        row.append(files::csvCell(fieldOf(*first, field))).append(1, ',');
    }
    header.back() = row.back() = '\n';
    return header + row;
}

std::string runsCsv(const StoredRuns& runs) {
    std::string text = "run_id,key,state_hash,method_hash,warnings\n";
    for (const auto& [id, run] : runs) {
        const auto key = run.provenance.find("key");
        text += fmt::format("{},{},{},{},{}\n", files::csvCell(id),
                            files::csvCell(key == run.provenance.end() ? "" : key->second), run.stateHash,
                            run.methodHash, files::csvCell(fmt::format("{}", fmt::join(run.warnings, "\n"))));
    }
    return text;
}

void addRunTable(const fs::path& folder, StoredRuns& runs, std::vector<std::string>& problems) {
    std::error_code none;
    if (!fs::exists(folder / runTable, none)) return;
    try {
        const auto table = files::CsvTable::parseFile(folder / runTable);
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const auto found = runs.find(table.cell(row, "run_id"));
            if (found == runs.end()) continue;
            StoredRun& run = found->second;
            run.provenance["key"] = table.cell(row, "key");
            run.stateHash = table.cell(row, "state_hash");
            run.methodHash = table.cell(row, "method_hash");
            run.warnings = linesOf(table.cell(row, "warnings"));
        }
    } catch (const InputError& fault) {
        problems.push_back(fmt::format("settings and warnings of the runs are not known: {}", fault.what()));
    }
}

}  // namespace dustbench::results
