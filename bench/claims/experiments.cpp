#include "bench/claims/experiments.h"

#include <fmt/format.h>

#include <limits>

#include "bench/world/world.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/csv.h"

namespace dustbench::claims {
namespace {

/// An empty field is a number that was not measured.
double numberOrNan(const files::CsvTable& table, std::size_t row, std::string_view column) {
    return table.cell(row, column).empty() ? std::numeric_limits<double>::quiet_NaN() : table.number(row, column);
}

class LentWorld final : public ExperimentWorld {
 public:
    LentWorld(const std::string& scene, const ParameterValues& parameters, std::uint64_t seed, int width, int height)
        : world_(scene, "", parameters, seed), width_(width), height_(height) {}

    [[nodiscard]] const scene::Scene& scene() const override { return world_.scene(); }
    [[nodiscard]] RunSetup setup() const override { return world_.setup(); }
    [[nodiscard]] Frame step() override {
        world_.step();
        view_ = world_.view(width_, height_);
        return {index_++, world::stepSeconds, world_.state(), world_.dust(), view_, untimed_};
    }

 private:
    world::World world_;
    int width_, height_;
    std::int64_t index_ = 0;
    scene::View view_;
    StageClock untimed_;
};

}  // namespace

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

gpu::Device& ProgramContext::device() {
    if (!device_) device_.emplace();
    return *device_;
}

std::unique_ptr<ExperimentWorld> ProgramContext::world(const std::string& scene,
                                                       const std::map<std::string, std::string>& parameters, int width,
                                                       int height) {
    ParameterValues values(world::worldParameters());
    for (const auto& [name, text] : parameters) values.set(name, text);
    return std::make_unique<LentWorld>(scene, values, seed_, width, height);
}

}  // namespace dustbench::claims
