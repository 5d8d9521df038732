#include "bench/suite/machine/machine_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>

#include "bench/suite/suite_cells.h"
#include "bench/suite/suite_plan.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::suite {
namespace fs = std::filesystem;
namespace {

constexpr double longest = 1e6;

fs::path planFile() {
    return files::findData("list of measurements", "machines", "measure-machine", ".toml");
}

struct PlanFile {
    struct NamedSuite {
        std::string id, load;
    };
    std::vector<NamedSuite> suites;
    LadderLimits hardware, software;
    double memoryShare = 1;
};

LadderLimits readLimits(files::TomlReader table) {
    LadderLimits limits;
    limits.totalSeconds = table.number("total_limit_s", 0.01, longest);
    limits.runSeconds = table.number("run_limit_s", 0.1, longest);
    limits.metricSeconds = table.number("judging_limit_s", 0.1, longest);
    table.finish();
    return limits;
}

PlanFile readPlanFile(bool quick) {
    files::TomlReader file = files::TomlReader::parseFile(planFile());
    PlanFile plan;
    plan.memoryShare = file.number("memory_share", 0.01, 1);
    for (files::TomlReader& table : file.tables("suite")) {
        plan.suites.push_back({table.text("id"), table.text("load", "")});
        table.finish();
    }
    if (plan.suites.empty()) throw InputError(file.where() + "expected one [[suite]] or more");
    plan.hardware = readLimits(file.table("hardware"));
    plan.software = readLimits(file.table("software"));
    const LadderLimits shorter = readLimits(file.table("quick"));
    if (quick) plan.hardware = plan.software = shorter;
    file.finish();
    return plan;
}

/// All settings but the load and the size.
std::string ladderOf(const results::RunSpec& spec, const std::string& load) {
    std::string text = fmt::format("{} {} {} {}", spec.method, spec.scene, spec.drive, spec.seed);
    for (const auto& [name, value] : spec.parameters)
        if (name != load) text += fmt::format(" {}={}", name, value);
    return text;
}

}  // namespace

MachinePlan loadMachinePlan(bool quick) {
    const PlanFile file = readPlanFile(quick);
    MachinePlan plan;
    plan.hardware = file.hardware;
    plan.software = file.software;
    plan.memoryShare = file.memoryShare;
    for (const auto& [id, load] : file.suites) {
        MachineSuite& each = plan.suites.emplace_back(loadSuite(id, quick), load);
        const bool isLoad = load.empty() || std::ranges::any_of(each.suite.cells, [&](const PlannedRun& cell) {
                                return cell.spec.parameters.contains(load);
                            });
        if (!isLoad) throw InputError(fmt::format("suite '{}': has no parameter '{}', expected its load", id, load));
    }
    return plan;
}

std::vector<fs::path> machinePlanFiles() {
    std::vector<fs::path> paths{planFile()};
    const std::vector<SuiteFile> known = listSuites();
    for (const auto& suite : readPlanFile(false).suites)
        if (const auto found = std::ranges::find(known, suite.id, &SuiteFile::id); found != known.end())
            paths.push_back(found->file);
    return paths;
}

double loadOf(const std::string& value) {
    double product = 1;
    for (std::string_view rest = value;;) {
        const std::size_t end = rest.find('x');
        const auto number = files::numberOf(std::string(rest.substr(0, end)));
        if (!number || *number <= 0)
            throw InputError(fmt::format("load: got '{}', expected a number above 0, or numbers joined by 'x'", value));
        product *= *number;
        if (end == std::string_view::npos) return product;
        rest.remove_prefix(end + 1);
    }
}

std::vector<PlacedCell> cellsOf(const MachinePlan& plan) {
    std::vector<PlacedCell> cells;
    std::set<std::string> known;  // suites share runs of the null method
    for (const auto& [suite, load] : plan.suites)
        for (PlannedRun cell : withBaselines(suite).cells) {
            const results::RunSpec& spec = cell.spec;
            if (!known.insert(results::runId(spec)).second) continue;
            const auto value = spec.parameters.find(load);
            LadderCell ladder{.suite = suite.id,
                              .ladder = ladderOf(spec, load),
                              .load = value == spec.parameters.end() ? 1 : loadOf(value->second),
                              .pixels = static_cast<double>(spec.size.width) * spec.size.height,
                              .repetitions = cell.repetitions > 0 ? cell.repetitions : suite.repetitions,
                              .evaluated = spec.metricPlan.has_value()};
            cells.push_back({std::move(cell), std::move(ladder)});
        }
    return cells;
}

RunNeeds needsOf(const results::StoredRun& run, const results::RunSpec& spec) {
    const auto number = [&](const char* column) { return numberIn(run, column).value_or(0); };
    const double all = number("run_s"), fps = number("fps_avg");
    double measuring = all;
    if (spec.metricPlan && fps > 0)
        measuring = std::min(all, number("start_s") + static_cast<double>(spec.warmup + spec.frames) / fps);
    return {.seconds = measuring,
            .metricSeconds = all - measuring,
            .hostBytes = number("rss_peak_bytes"),
            .deviceBytes = number("gpu_bytes")};
}

}  // namespace dustbench::suite
