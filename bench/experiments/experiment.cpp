#include "bench/experiments/experiment.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/experiments/birth_experiment.h"
#include "bench/experiments/obstacle_experiment.h"
#include "bench/experiments/sampling_experiment.h"
#include "bench/experiments/sight_experiment.h"
#include "methods/shared/errors.h"
#include "methods/shared/files/csv.h"

namespace dustbench::bench {

const std::vector<std::string>& experimentNames() {
    static const std::vector<std::string> names{"sampling", "obstacles", "sight", "births"};
    return names;
}

std::vector<Finding> runExperiment(std::string_view name, std::uint64_t seed) {
    if (std::ranges::find(experimentNames(), name) == experimentNames().end())
        throw unknownName("experiment", std::string(name), experimentNames());
    if (name == "obstacles") return blowAtObstacles();
    if (name == "births") return lookForBirthsInSolids();
    return name == "sight" ? lookAtABox() : sampleDirections(seed);
}

std::string findingsCsv(const std::vector<Finding>& findings) {
    std::string text = "experiment,quantity,value,low,high,samples\n";
    for (const Finding& finding : findings)
        text +=
            fmt::format("{},{},{},{},{},{}\n", finding.experiment, finding.quantity, files::csvNumber(finding.value),
                        files::csvNumber(finding.low), files::csvNumber(finding.high), finding.samples);
    return text;
}

std::vector<Finding> readFindings(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "experiments.csv";
    std::vector<Finding> findings;
    if (!std::filesystem::exists(file)) return findings;
    const files::CsvTable table = files::CsvTable::parseFile(file);
    for (std::size_t row = 0; row < table.rows(); ++row)
        findings.push_back({table.cell(row, "experiment"), table.cell(row, "quantity"), table.number(row, "value"),
                            table.number(row, "low"), table.number(row, "high"),
                            static_cast<std::int64_t>(table.number(row, "samples"))});
    return findings;
}

}  // namespace dustbench::bench
