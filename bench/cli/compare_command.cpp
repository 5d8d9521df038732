// `dustbench compare`: methods side by side in one world, in numbers and on a contact sheet.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/shared_options.h"
#include "bench/cli/suite_report.h"
#include "bench/cli/world_options.h"
#include "bench/run/comparison_sheet.h"
#include "bench/run/method_comparison.h"
#include "methods/shared/errors.h"

namespace dustbench::cli {
namespace {

struct CompareOptions {
    std::vector<std::string> methods;
    WorldOptions world;
    std::int64_t frames = bench::RunSpec().frames, repetitions = 6;
    std::string moments, out = "out/compare";
};

bench::ParameterTexts singleValues(const std::vector<std::string>& texts) {
    bench::ParameterTexts values;
    for (const auto& [name, list] : parseParameters(texts)) {
        if (list.size() != 1)
            throw InputError(
                fmt::format("-P {}: got {} values, allowed: 1 (methods may differ by "
                            "METHOD:name=value)",
                            name, list.size()));
        values[name] = list.front();
    }
    return values;
}

void writeSheet(const bench::Suite& suite, const bench::ResultsFolder& results) {
    std::vector<bench::SheetRun> runs;
    for (const bench::PlannedRun& cell : suite.cells)
        if (bench::doneRun(cell, 1, results.runs()))
            runs.push_back({bench::runId(bench::inRepetition(cell.spec, 1)),
                            cell.spec.method + (cell.label.empty() ? "" : " " + cell.label)});
    if (runs.empty()) return;
    const std::filesystem::path file = results.path() / "contact_sheet.png";
    draw::writeImage(bench::drawSheet(bench::comparisonSheet(results, runs, suite.title)), file);
    std::cout << file.string() << "\n";
}

int compare(const CompareOptions& options) {
    for (const std::string& method : options.methods)
        if (method.find('/') != std::string::npos)
            throw InputError(fmt::format("compare: got '{}', expected methods", method));
    bench::RunSpec base = options.world.toWorldSpec();
    base.frames = options.frames;
    base.judging.emplace();
    if (!options.moments.empty()) base.judging->moments = bench::parseFrameRange("--moments", options.moments);
    bench::Suite suite = bench::compareMethods(options.methods, singleValues(options.world.parameters), base,
                                               static_cast<int>(options.repetitions));
    suite.title +=
        fmt::format(": {}{}, {} frames", base.scene, base.drive.empty() ? "" : ", " + base.drive, base.frames);
    const auto plan = bench::planRuns(suite);
    checkWorlds(plan);
    bench::ResultsFolder results(options.out);
    PlanOptions planOptions;
    planOptions.timeoutSeconds = suite.timeoutSeconds;
    const int code = runPlan(plan, suite.repetitions, results, planOptions);
    if (code == exitAborted) return code;
    std::cout << suiteReport(suite, results.runs()) << "\n" << (results.path() / "summary.csv").string() << "\n";
    writeSheet(suite, results);
    return code;
}

}  // namespace

Command compareCommand() {
    auto options = std::make_shared<CompareOptions>();
    return {"compare", "Put methods side by side: frame times with intervals, metrics, and a contact sheet",
            "A method may come with parameters of its own: billboard:soft=true,sort=none\n"
            "Runs whose results are there already are left alone. reports/METRICS.md defines the metrics.",
            [options](Arguments& arguments) {
                arguments.requiredTexts("methods", "METHOD", "two or more of `dustbench list methods`",
                                        options->methods);
                options->world.declareWorld(arguments);
                arguments.integer("--frames", "frames to record", options->frames, 1, 10'000'000);
                arguments.text("--moments", "A:B:STEP",
                               "frames to judge and show, 5 or more, without B; five from first to last unless given",
                               options->moments);
                arguments.integer("--repetitions", "of every run, each a fresh process; below 6 no verdict is given",
                                  options->repetitions, 1, 1000);
                arguments.text("--out", "DIR", "folder for the results; made where it is missing", options->out);
            },
            [options] { return compare(*options); }};
}

}  // namespace dustbench::cli
