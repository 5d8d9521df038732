// `dustbench compare`: methods side by side in one world, in numbers and on a contact sheet; or two results folders.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iostream>
#include <memory>
#include <set>

#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/regression_check.h"
#include "bench/cli/shared_options.h"
#include "bench/cli/suite_report.h"
#include "bench/cli/world_options.h"
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
    std::int64_t frames = bench::RunSpec().frames, repetitions = 6;
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
            throw InputError(fmt::format("{}: got it for {}, allowed: for {}", name,
                                         folders ? "result folders" : "methods",
                                         folders ? "methods" : "two result folders"));
}

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

/// The sheet of all done runs; the exact pictures come from those that are judged.
void writeSheet(const bench::Suite& suite, const bench::ResultsFolder& results) {
    std::vector<bench::SheetRun> runs;
    for (const bench::PlannedRun& cell : suite.cells) {
        const std::string id = bench::runId(bench::inRepetition(cell.spec, 1));
        if (bench::doneRun(cell, 1, results.runs()))
            runs.push_back({id, cell.spec.method + (cell.label.empty() ? "" : " " + cell.label),
                            std::filesystem::exists(results.runFolder(id) / "metrics.csv")});
    }
    if (std::ranges::none_of(runs, &bench::SheetRun::judged)) {
        std::cout << "no contact sheet: no run could be compared with exact pictures\n";
        return;
    }
    const bench::ContactSheet sheet = bench::sideBySideSheet(results, runs, suite.title);
    std::cout << bench::writeContactSheet(sheet, results.path()).string() << "\n";
    try {
        std::cout << bench::drawContactSheet(results.path()).string() << "\n";
    } catch (const InputError& error) {
        std::cout << "no contact_sheet.png: " << error.what() << "\n";
    }
}

/// A method's name means the method; what follows its ':' may be the path of a file.
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
                "compare: got '{}' beside a result folder, allowed: methods, or two folders that exist", each));
    if (options.methods.size() != 2)
        throw InputError(fmt::format("compare: got {} result folders, allowed: 2", options.methods.size()));
    refuseOthers(options, true);
    RegressionOptions folders{options.methods[0],     options.methods[1], options.columns, options.out, {},
                              options.acrossMachines, options.markdown};
    if (!options.failPercent.empty()) folders.failPercent = parsePercent(options.failPercent);
    return checkRegression(folders);
}

int compare(const CompareOptions& options) {
    if (std::ranges::any_of(options.methods, isFolder)) return compareFolderArguments(options);
    refuseOthers(options, false);
    bench::RunSpec base = options.world.toWorldSpec();
    base.frames = options.frames;
    base.judging.emplace();
    if (!options.moments.empty()) base.judging->moments = bench::parseFrameRange("--moments", options.moments);
    bench::Suite suite = bench::sideBySideSuite(options.methods, singleValues(options.world.parameters), base,
                                                static_cast<int>(options.repetitions));
    suite.title += fmt::format(": {}{}, {} frame{}", base.scene, base.drive.empty() ? "" : ", " + base.drive,
                               base.frames, base.frames == 1 ? "" : "s");
    const auto plan = bench::planRuns(suite);
    checkWorlds(plan);
    requireOpenGl();
    bench::ResultsFolder results(options.out.empty() ? "out/compare" : options.out);
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
    return {"compare", "Compare methods, or two folders of results: times with intervals",
            "Methods: frame times, metrics and a contact sheet. A method may have parameters of its own:\n"
            "billboard:soft=true,sort=none. Existing results are kept.\n"
            "reports/METRICS.md defines the metrics.\n"
            "Two folders: for every run in both, the times of the second over those of the first.\n"
            "Exit code 5: a regression; 6: not comparable.",
            [options](Arguments& arguments) {
                arguments.requiredTexts("methods", "METHOD|DIR",
                                        "two or more of `dustbench list methods`; or two folders of results",
                                        options->methods);
                options->world.declareWorld(arguments);
                arguments.integer("--frames", "frames to record", options->frames, 1, 10'000'000);
                arguments.text("--moments", "A:B:STEP",
                               "frames to judge and show, 5 or more, without B; default: five from first to last",
                               options->moments);
                arguments.integer("--repetitions", "of every run, each in a new process; fewer than 6 give no verdict",
                                  options->repetitions, 1, files::limits::repetitions);
                arguments.text("--out", "DIR",
                               "folder for the results, default: out/compare; for folders: where comparison.csv goes",
                               options->out);
                arguments.text("--fail-on-regression", "PERCENT",
                               "for folders: exit code 5 if the second is slower by more than this, also when it is "
                               "measured again, or fails where the first does not",
                               options->failPercent);
                arguments.text("--markdown", "FILE", "for folders: the result for a merge request", options->markdown);
                arguments.text("--columns", "NAME,NAME…",
                               "for folders: times or rates of summary.csv; default: frame_ms_median",
                               options->columns);
                arguments.flag("--across-machines", "for folders: compare runs of different machines or builds",
                               options->acrossMachines);
                arguments.givenOptions(options->given);
            },
            [options] { return compare(*options); }};
}

}  // namespace dustbench::cli
