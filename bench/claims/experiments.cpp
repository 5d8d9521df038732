#include "bench/claims/experiments.h"

#include <fmt/format.h>

#include "bench/claims/lent_context.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {

std::vector<std::string> experimentNames() {
    std::vector<std::string> names;
    for (const ExperimentInfo& info : experiments()) names.push_back(info.id);
    return names;
}

std::vector<StoredFinding> runExperiment(std::string_view name, std::uint64_t seed) {
    const ExperimentInfo& info = findExperiment(name);
    LentContext context(seed);
    std::vector<StoredFinding> findings;
    for (Finding& finding : info.run(context)) findings.push_back({std::move(finding), info.id});
    return findings;
}

std::string findingsCsv(const std::vector<StoredFinding>& findings) {
    std::string text = "experiment,quantity,value,low,high,samples\n";
    for (const StoredFinding& finding : findings)
        text +=
            fmt::format("{},{},{},{},{},{}\n", finding.experiment, finding.quantity, files::csvNumber(finding.value),
                        files::csvNumber(finding.low), files::csvNumber(finding.high), finding.samples);
    return text;
}

std::vector<StoredFinding> readFindings(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "experiments.csv";
    std::vector<StoredFinding> findings;
    if (!std::filesystem::exists(file)) return findings;
    const files::CsvTable table = files::CsvTable::parseFile(file);
    for (std::size_t row = 0; row < table.rows(); ++row)
        findings.push_back({{table.cell(row, "quantity"), table.number(row, "value"), table.number(row, "low"),
                             table.number(row, "high"), static_cast<std::int64_t>(table.number(row, "samples"))},
                            table.cell(row, "experiment")});
    return findings;
}

}  // namespace dustbench::bench
