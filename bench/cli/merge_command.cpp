// `dustbench merge`: merges the results of several machines into one folder.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <set>

#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/results/compared_runs.h"
#include "bench/results/merge.h"
#include "bench/results/stored_run.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {
namespace fs = std::filesystem;

struct MergeOptions {
    std::string out;
    std::vector<std::string> sources;
};

/// Prints each difference between the machine of a run and that of the first run, once.
void sayWhereMachinesDiffer(const results::StoredRuns& runs) {
    const results::StoredRun* first = nullptr;
    std::set<std::string> said;
    for (const auto& [id, run] : runs) {
        if (run.status != results::RunStatus::done) continue;
        if (!first) first = &run;
        for (const auto& [field, mine, other] : results::differences(*first, run, results::machineFields()))
            if (const std::string text = fmt::format("{}: '{}' and '{}'", field, mine, other); said.insert(text).second)
                std::cerr << "note: the runs are from different machines, " << files::printable(text) << "\n";
    }
}

/// Plans the copies. If that fails, removes the empty folder of `results` if it was `missing` before.
results::MergePlan planWhole(const std::vector<results::MergeSource>& sources, const results::ResultsFolder& results,
                             const std::vector<fs::path>& missing) {
    try {
        results::MergePlan plan = results::planMerge(sources, results);
        results::requireSpace(plan, results.path(), fs::space(results.path()).available);
        return plan;
    } catch (...) {
        std::error_code notEmpty;
        for (const fs::path& each : missing) fs::remove(each, notEmpty);
        throw;
    }
}

int mergeFolders(const MergeOptions& options) {
    std::vector<results::MergeSource> sources;
    sources.reserve(options.sources.size());
    for (const std::string& folder : options.sources) sources.emplace_back(folder, results::readStoredRuns(folder));
    std::vector<fs::path> missing;
    for (const fs::path& each : {fs::path(options.out) / "runs", fs::path(options.out)})
        if (!fs::exists(each)) missing.push_back(each);
    results::ResultsFolder results(options.out);
    const results::MergePlan plan = planWhole(sources, results, missing);
    listenForInterruption();
    if (!results::merge(plan, results, interrupted)) {
        std::cerr << "aborted; repeat the command to resume" << std::endl;
        return exitAborted;
    }
    sayWhereMachinesDiffer(results.runs());
    if (const std::string said = results::saysNothingOfOutputs(results.runs()); !said.empty())
        std::cerr << "warning: " << said << "\n";
    std::cerr << fmt::format("{} copied, {} existing\n", plan.copies.size(), plan.there);
    std::cout << (results.path() / "summary.csv").string() << "\n";
    return exitOk;
}

}  // namespace

Command mergeCommand() {
    auto options = std::make_shared<MergeOptions>();
    return {"merge", "Merge the results of several machines into one folder",
            "Existing runs are kept. Two different results of the same run are an error.",
            [options](Arguments& arguments) {
                arguments.required("--out", "DIR", "folder for the merged results; created if missing", options->out);
                arguments.requiredTexts("folders", "DIR", "results folders, such as the shards of a suite",
                                        options->sources);
            },
            [options] { return mergeFolders(*options); }};
}

}  // namespace dustbench::cli
