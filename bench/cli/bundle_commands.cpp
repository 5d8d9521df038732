// `dustbench bundle` packs results with everything they depend on into one file. `dustbench verify` checks such a file
// and repeats its simulations.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/measure/sha256.h"
#include "bench/results/stored_run.h"
#include "bench/results/temporary_folder.h"
#include "bench/suite/bundle/bundle.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace fs = std::filesystem;
namespace {

struct BundleOptions {
    std::string results;
    std::string out;
};

int writeBundle(const BundleOptions& options) {
    const fs::path results = fs::absolute(options.results).lexically_normal();
    const fs::path folder = results.has_filename() ? results : results.parent_path();
    const fs::path archive =
        options.out.empty() ? fs::path(folder.filename().string() + ".tar") : fs::path(options.out);
    if (fs::exists(fs::symlink_status(archive)))
        throw InputError(fmt::format("bundle '{}' already exists; choose a new name", archive.string()));
    const suite::PackedBundle packed = suite::packBundle(folder, archive);
    for (const std::string& missing : packed.missing) std::cerr << "note: " << files::printable(missing) << "\n";
    std::cerr << fmt::format("{} files, {:.1f} MB\n", packed.files, static_cast<double>(packed.bytes) / 1e6);
    std::cout << archive.string() << "\n";
    return exitOk;
}

struct VerifyOptions {
    std::string bundle;
    std::int64_t runs = -1;
    double timeoutSeconds = 600;
};

/// At most `most` of them, evenly spread; all if it is negative.
std::vector<suite::ExactRun> chosen(std::vector<suite::ExactRun> all, std::int64_t most) {
    const std::size_t count = most < 0 ? all.size() : std::min(all.size(), static_cast<std::size_t>(most));
    std::vector<suite::ExactRun> some;
    some.reserve(count);
    for (std::size_t i = 0; i < count; ++i) some.push_back(std::move(all[i * all.size() / count]));
    return some;
}

/// Why the run cannot be repeated here; empty if it can. Files with absolute paths are not taken from the bundle.
std::string whyNotHere(const suite::ExactRun& exact, const results::StoredRun& run) {
    for (const measure::InputHash& input : run.inputs)
        if (fs::path(input.file).is_absolute() && measure::sha256OfFile(input.file) != input.sha256)
            return fmt::format("'{}' is missing or has changed", input.file);
    try {
        (void)results::canonicalParameters(findMethod(exact.spec.method), exact.spec.parameters);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string nameOf(const suite::ExactRun& exact) {
    const std::size_t others = exact.runIds.size() - 1;
    return exact.runIds.front() + (others == 0 ? "" : fmt::format(" and {} more", others));
}

/// Prints a line for each repeated simulation; false unless all hashes are the same.
bool printComparison(const std::vector<suite::ExactRun>& repeated, const results::StoredRuns& again) {
    bool isSame = true;
    for (const suite::ExactRun& exact : repeated) {
        const results::StoredRun& run = again.at(results::runId(exact.spec));
        const std::string difference = run.status == results::RunStatus::done
                                           ? suite::hashDifference(run, exact)
                                           : "the repetition failed: " + files::printable(run.reason);
        isSame = isSame && difference.empty();
        std::cout << fmt::format("{}: {}\n", nameOf(exact), difference.empty() ? "the same hashes" : difference);
    }
    return isSame;
}

/// Runs the simulations again with the bundle's data and compares their hashes.
int repeatRuns(const suite::OpenedBundle& bundle, const std::vector<suite::ExactRun>& exact, double timeoutSeconds,
               const fs::path& below) {
    if (const fs::path inputs = bundle.folder / "inputs"; fs::is_directory(inputs)) {
        std::vector<std::string> folders{inputs.string()};
        for (const fs::path& named : files::namedDataFolders()) folders.push_back(named.string());
        files::useDataFolders("bundle", folders);
    }
    std::vector<suite::ExactRun> repeated;
    std::vector<suite::PlannedRun> plan;
    for (const suite::ExactRun& each : exact) {
        const std::string whyNot = whyNotHere(each, bundle.runs.at(each.runIds.front()));
        if (!whyNot.empty()) {
            std::cout << fmt::format("{}: not repeated: {}\n", nameOf(each), files::printable(whyNot));
            continue;
        }
        plan.push_back({each.spec, ""});
        repeated.push_back(each);
    }
    if (plan.empty()) return exitOk;
    requireOpenGl();
    results::ResultsFolder again(below / "again");
    run::ExecutionOptions execution = childExecution();
    execution.timeoutSeconds = timeoutSeconds;
    ProgressPrinter printer;
    if (run::execute(plan, 1, again, execution, printer).aborted) {
        std::cerr << "aborted" << std::endl;
        return exitAborted;
    }
    return printComparison(repeated, again.runs()) ? exitOk : exitRunFailed;
}

int verifyBundle(const VerifyOptions& options) {
    const results::TemporaryFolder temporary;
    const suite::OpenedBundle bundle = suite::openBundle(options.bundle, temporary.path());
    const std::vector<suite::ExactRun> exact = suite::exactRuns(bundle.runs);
    std::cout << fmt::format("{} files are unchanged: {} runs of {} simulations\n", bundle.files, bundle.runs.size(),
                             exact.size());
    return repeatRuns(bundle, chosen(exact, options.runs), options.timeoutSeconds, temporary.path());
}

}  // namespace

Command bundleCommand() {
    auto options = std::make_shared<BundleOptions>();
    return {"bundle", "Pack results with their suite, inputs and checksums into one file",
            "The file is a tar archive; `sha256sum --check SHA256SUMS` in it needs no dustbench.",
            [options](Arguments& arguments) {
                arguments.required("dir", "DIR", "results folder written by `suite`, `run`, `compare` or `reproduce`",
                                   options->results);
                arguments.text("--out", "FILE", "bundle to write; default: the folder's name with .tar", options->out);
            },
            [options] { return writeBundle(*options); }};
}

Command verifyCommand() {
    auto options = std::make_shared<VerifyOptions>();
    return {"verify", "Check a bundle and repeat its simulations",
            "Compares hashes of the state after the last frame, which are the same on every machine. Times are not "
            "compared.",
            [options](Arguments& arguments) {
                arguments.required("bundle", "FILE", "file written by `bundle`", options->bundle);
                arguments.integer("--runs", "number of simulations to repeat, evenly spread; -1: all", options->runs,
                                  -1, std::numeric_limits<std::int64_t>::max());
                arguments.number("--timeout", "time limit of one run in seconds", options->timeoutSeconds, 1, 1e6);
            },
            [options] { return verifyBundle(*options); }};
}

}  // namespace dustbench::cli
