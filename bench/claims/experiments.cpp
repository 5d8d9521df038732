#include "bench/claims/experiments.h"

#include <fmt/format.h>

#include <limits>

#include "bench/claims/lent_context.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

/// An empty field is a number that was not measured.
double numberOrNan(const files::CsvTable& table, std::size_t row, std::string_view column) {
    return table.cell(row, column).empty() ? std::numeric_limits<double>::quiet_NaN() : table.number(row, column);
}

}  // namespace

std::vector<std::string> experimentNames() {
    std::vector<std::string> names;
    for (const ExperimentInfo& info : experiments()) names.push_back(info.id);
    return names;
}

std::vector<StoredFinding> runExperiment(std::string_view name, bool quick, std::uint64_t seed) {
    const ExperimentInfo& info = findExperiment(name);
    ProgramContext context(seed, quick);
    std::vector<StoredFinding> findings;
    for (Finding& finding : info.run(context)) findings.push_back({std::move(finding), info.id});
    return findings;
}

std::string findingsCsv(const std::vector<StoredFinding>& findings) {
    std::string text = "experiment,quantity,value,low,high,samples,note\n";
    for (const StoredFinding& finding : findings)
        text += fmt::format("{},{},{},{},{},{},{}\n", finding.experiment, finding.quantity,
                            files::csvNumber(finding.value), files::csvNumber(finding.low),
                            files::csvNumber(finding.high), finding.samples, files::csvCell(finding.note));
    return text;
}

std::vector<StoredFinding> readFindings(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "experiments.csv";
    std::vector<StoredFinding> findings;
    std::error_code missing;
    if (!std::filesystem::exists(std::filesystem::symlink_status(file, missing))) return findings;
    const files::CsvTable table = files::CsvTable::parseFile(file);
    const bool hasNotes = table.hasColumn("note");  // older results have none
    for (std::size_t row = 0; row < table.rows(); ++row)
        findings.push_back(
            {{table.cell(row, "quantity"), numberOrNan(table, row, "value"), numberOrNan(table, row, "low"),
              numberOrNan(table, row, "high"), static_cast<std::int64_t>(table.number(row, "samples")),
              hasNotes ? table.cell(row, "note") : std::string()},
             table.cell(row, "experiment")});
    return findings;
}

}  // namespace dustbench::bench
