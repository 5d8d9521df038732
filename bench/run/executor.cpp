#include "bench/run/executor.h"

#include <chrono>

#include "bench/run/child_process.h"
#include "bench/run/summary.h"
#include "methods/shared/errors.h"

namespace dustbench::bench {
namespace fs = std::filesystem;
namespace {

bool isFailure(RunStatus status) {
    return status == RunStatus::failed || status == RunStatus::timeout;
}

bool isThere(const ResultsFolder& results, const std::string& id, const ExecutionOptions& options) {
    const auto found = results.runs().find(id);
    if (found == results.runs().end() || options.force) return false;
    return !(options.retryFailed && isFailure(found->second.status));
}

/// What is left of a run that did not end well: its reason and its log.
void keepFailure(const fs::path& folder, const RunSpec& spec, RunStatus status, const std::string& reason,
                 const ExecutionOptions& options) {
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename() != "log.txt") fs::remove_all(entry.path());
    RunRecord record;
    record.spec = spec;
    record.drive = spec.drive;
    record.status = status;
    record.reason = reason;
    record.provenance = startProvenance(options.argv);
    record.summary = identityColumns(record, spec.threads == 0 ? record.provenance.machine.cores : spec.threads);
    writeWhole(folder / "run.json", toJson(record));
}

struct Outcome {
    RunStatus status = RunStatus::done;
    std::string reason;
    bool aborted = false;
};

Outcome runOne(const PlannedRun& run, ResultsFolder& results, const ExecutionOptions& options,
               ExecutionListener& listener) {
    const std::string id = runId(run.spec);
    const fs::path folder = results.beginRun(id);
    const fs::path specFile = folder / "spec.json";
    writeWhole(specFile, specToJson(run.spec));

    std::string progress;
    ChildCommand command;
    command.argv = options.command(specFile, folder);
    command.log = folder / "log.txt";
    command.timeoutSeconds = options.timeoutSeconds;
    command.interrupted = options.interrupted;
    command.onLine = [&](std::string_view line) {
        if (!line.empty()) progress = line;
        listener.heard(line);
    };
    const ChildOutcome outcome = runChild(command);
    using End = ChildOutcome::End;
    if (outcome.end == End::interrupted) {
        results.discard(id);
        return {RunStatus::failed, "interrupted", true};
    }
    if (options.badInputEnds && outcome.end == End::exited && outcome.code == 3) {
        results.discard(id);
        constexpr std::string_view prefix = "dustbench: ";
        throw InputError(outcome.lastWords.starts_with(prefix) ? outcome.lastWords.substr(prefix.size())
                                                               : outcome.lastWords);
    }

    fs::remove(specFile);
    if (!outcome.succeeded() || !fs::exists(folder / "run.json")) {
        const RunStatus status = outcome.end == End::timedOut ? RunStatus::timeout : RunStatus::failed;
        std::string reason = outcome.succeeded() ? "ended without a result" : outcome.reason();
        if (status == RunStatus::timeout) reason += progress.empty() ? "" : " (at " + progress + ")";
        keepFailure(folder, run.spec, status, reason, options);
    } else if (fs::file_size(command.log) == 0) {
        fs::remove(command.log);
    }
    results.publish(id);
    const StoredRun& stored = results.runs().at(id);
    return {stored.status, stored.reason, false};
}

}  // namespace

ExecutionResult execute(const std::vector<PlannedRun>& plan, int repetitions, ResultsFolder& results,
                        const ExecutionOptions& options, ExecutionListener& listener) {
    using Clock = std::chrono::steady_clock;
    ExecutionResult result;
    std::size_t toDo = 0;
    std::vector<bool> there;
    for (const PlannedRun& run : plan) {
        there.push_back(isThere(results, runId(run.spec), options));
        if (!there.back()) ++toDo;
    }

    const auto start = Clock::now();
    std::size_t finished = 0;
    for (std::size_t i = 0; i < plan.size() && !result.aborted; ++i) {
        if (there[i]) {
            ++result.kept;
            if (isFailure(results.runs().at(runId(plan[i].spec)).status)) ++result.failed;
            continue;
        }
        const std::chrono::duration<double> elapsed = Clock::now() - start;
        const double eta =
            finished == 0 ? -1 : elapsed.count() / static_cast<double>(finished) * static_cast<double>(toDo - finished);
        listener.started(i + 1, plan.size(), plan[i], repetitions, eta);
        const Outcome outcome = runOne(plan[i], results, options, listener);
        if (outcome.aborted) {
            result.aborted = true;
            continue;
        }
        listener.ended(plan[i], outcome.status, outcome.reason);
        ++finished;
        if (isFailure(outcome.status))
            ++result.failed;
        else
            ++(outcome.status == RunStatus::skipped ? result.skipped : result.done);
    }
    results.writeSummary();
    return result;
}

}  // namespace dustbench::bench
