#include "bench/results/run_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

constexpr const char* name = "runs.csv";

std::vector<std::string> linesOf(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}  // namespace

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

void addRunTable(const std::filesystem::path& folder, StoredRuns& runs, std::vector<std::string>& problems) {
    std::error_code none;
    if (!std::filesystem::exists(folder / name, none)) return;
    try {
        const auto table = files::CsvTable::parseFile(folder / name);
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

}  // namespace dustbench::bench
