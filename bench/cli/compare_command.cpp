// `dustbench compare`: compares methods in one world, with tables and a contact sheet; or two results folders.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iostream>
#include <memory>
#include <set>

#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/regression_check.h"
#include "bench/cli/shared_options.h"
#include "bench/cli/suite_report.h"
#include "bench/report/side_by_side_sheet.h"
#include "bench/suite/side_by_side.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/limits.h"

namespace dustbench::cli {
namespace {

struct CompareOptions {
    std::vector<std::string> methods;
    WorldOptions world;
    std::int64_t frames = results::RunSpec().frames, repetitions = 6;
    std::string moments, out;
    std::string columns;
    std::string failPercent, markdown;
    bool acrossMachines = false;
    std::vector<std::string> given;  ///< names of options
};

/// Throws if an option was given that applies only to the other kind of comparison.
void refuseOthers(const CompareOptions& options, bool folders) {
    static const std::set<std::string> both{"--out", "--adapter", "--data"},
        ofFolders{"--columns", "--fail-on-regression", "--across-machines", "--markdown"};
    for (const std::string& name : options.given)
        if (!both.contains(name) && ofFolders.contains(name) != folders)
            throw InputError(fmt::format("{}: applies only to {}, not to {}", name,
                                         folders ? "methods" : "two results folders",
                                         folders ? "results folders" : "methods"));
}

results::ParameterTexts singleValues(const std::vector<std::string>& texts) {
    results::ParameterTexts values;
    for (const auto& [name, list] : parseParameters(texts)) {
        if (list.size() != 1)
            throw InputError(
                fmt::format("-P {}: got {} values, allowed: 1 (to set it for one method: "
                            "METHOD:name=value)",
                            name, list.size()));
        values[name] = list.front();
    }
    return values;
}

/// Writes the contact sheet of all completed runs. The reference images come from the runs that have metrics.
void writeSheet(const suite::Suite& suite, const results::ResultsFolder& results) {
    std::vector<report::SheetRun> runs;
    for (const suite::PlannedRun& cell : suite.cells) {
        const std::string id = results::runId(suite::inRepetition(cell.spec, 1));
        if (suite::doneRun(cell, 1, results.runs()))
            runs.push_back({id, cell.spec.method + (cell.label.empty() ? "" : " " + cell.label),
                            std::filesystem::exists(results.runFolder(id) / "metrics.csv")});
    }
    if (std::ranges::none_of(runs, &report::SheetRun::evaluated)) {
        std::cout << "no contact sheet: no run could be compared with a reference image\n";
        return;
    }
    const report::ContactSheet sheet = report::sideBySideSheet(results, runs, suite.title);
    std::cout << report::writeContactSheet(sheet, results.path()).string() << "\n";
    try {
        std::cout << report::drawContactSheet(results.path()).string() << "\n";
    } catch (const InputError& error) {
        std::cout << "no contact_sheet.png: " << error.what() << "\n";
    }
}

/// The name of a method is never a folder. A path after its ':' is the value of a parameter.
bool isFolder(const std::string& text) {
    const std::string name = text.substr(0, text.find(':'));
    if (std::ranges::find(methods(), name, &MethodInfo::id) != methods().end()) return false;
    return name.find('/') != std::string::npos || std::filesystem::is_directory(text);
}

double parsePercent(const std::string& text) {
    double percent = 0;
    const char* const end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, percent);
    if (error != std::errc() || at != end || !(percent >= 0 && percent <= 1e6))
        throw InputError(fmt::format("--fail-on-regression: got '{}', allowed: per cent, 0..1000000", text));
    return percent;
}

int compareFolderArguments(const CompareOptions& options) {
    for (const std::string& each : options.methods)
        if (!isFolder(each))
            throw InputError(fmt::format(
                "compare: got '{}' together with a results folder, allowed: only methods, or two existing folders",
                each));
    if (options.methods.size() != 2)
        throw InputError(fmt::format("compare: got {} results folders, allowed: 2", options.methods.size()));
    refuseOthers(options, true);
    RegressionOptions folders{options.methods[0],     options.methods[1], options.columns, options.out, {},
                              options.acrossMachines, options.markdown};
    if (!options.failPercent.empty()) folders.failPercent = parsePercent(options.failPercent);
    return checkRegression(folders);
}

int compare(const CompareOptions& options) {
    if (std::ranges::any_of(options.methods, isFolder)) return compareFolderArguments(options);
    refuseOthers(options, false);
    results::RunSpec base = options.world.toWorldSpec();
    base.frames = options.frames;
    base.metricPlan.emplace();
    if (!options.moments.empty()) base.metricPlan->moments = exports::parseFrameRange("--moments", options.moments);
    suite::Suite suite = suite::sideBySideSuite(options.methods, singleValues(options.world.parameters), base,
                                                static_cast<int>(options.repetitions));
    suite.title += fmt::format(": {}{}, {} frame{}", base.scene, base.drive.empty() ? "" : ", " + base.drive,
                               base.frames, base.frames == 1 ? "" : "s");
    const auto plan = suite::planRuns(suite);
    checkWorlds(plan);
    requireOpenGl();
    results::ResultsFolder results(options.out.empty() ? "out/compare" : options.out);
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
    return {"compare", "Compare methods or two results folders, with confidence intervals",
            "Methods: prints frame times and metrics and draws a contact sheet. Parameters of one method follow its\n"
            "name: billboard:soft=true,sort=none. Existing results are kept.\n"
            "reports/METRICS.md defines the metrics.\n"
            "Two folders: for every run in both, the ratio of its times, second folder over first.\n"
            "Exit code 5: a regression; 6: not comparable.",
            [options](Arguments& arguments) {
                arguments.requiredTexts("methods", "METHOD|DIR",
                                        "two or more of `dustbench list methods`; or two results folders",
                                        options->methods);
                options->world.declareWorld(arguments);
                arguments.integer("--frames", "frames to record", options->frames, 1, 10'000'000);
                arguments.text("--moments", "A:B:STEP",
                               "frames to compare with the reference and to show, 5 or more, excluding B; default: "
                               "five from first to last",
                               options->moments);
                arguments.integer("--repetitions",
                                  "runs of every configuration, each in a new process; fewer than 6 give no verdict",
                                  options->repetitions, 1, files::limits::repetitions);
                arguments.text("--out", "DIR",
                               "folder for the results, default: out/compare; for two folders: folder for "
                               "comparison.csv",
                               options->out);
                arguments.text("--fail-on-regression", "PERCENT",
                               "for two folders: exit code 5 if the second is slower by more than this, confirmed by "
                               "measuring again, or if a run fails only in the second",
                               options->failPercent);
                arguments.text("--markdown", "FILE",
                               "for two folders: also write the result as Markdown, for a merge request",
                               options->markdown);
                arguments.text("--columns", "NAME,NAME…",
                               "for two folders: times or rates of summary.csv to compare; default: frame_ms_median",
                               options->columns);
                arguments.flag("--across-machines",
                               "for two folders: also compare runs of different machines or builds",
                               options->acrossMachines);
                arguments.givenOptions(options->given);
            },
            [options] { return compare(*options); }};
}

}  // namespace dustbench::cli
