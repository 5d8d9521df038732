#include "bench/run/executor.h"

#include <fmt/format.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "bench/results/disk_need.h"
#include "bench/results/freshness.h"
#include "bench/results/summary.h"
#include "bench/run/child_process.h"
#include "bench/run/remaining_time.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::bench {
namespace fs = std::filesystem;
namespace {

bool isFailure(RunStatus status) {
    return status == RunStatus::failed || status == RunStatus::timeout;
}

/// Space to keep free for tables and logs.
constexpr std::uint64_t reserveBytes = 16 << 20;

void requireRoom(const ResultsFolder& results, std::uint64_t bytes) {
    const std::uint64_t free = freeBytes(results.path());
    if (free < bytes)
        throw files::MachineError(
            fmt::format("output '{}' cannot be written: the disk has {} left and the next run may "
                        "need {}",
                        results.path().string(), bytesText(free), bytesText(bytes)));
}

/// A file of a MiB can be made in the folder: quotas and inodes have no other sign that every file system gives.
void requireWritable(const fs::path& folder) {
    writeWhole(folder / "probe", std::string(std::size_t{1} << 20, 'x'));
    fs::remove(folder / "probe");
}

/// Begins the reason of runs that their suite leaves out; later suites may run them.
constexpr std::string_view leftOut = "left out by the suite: ";

/// The suite left it out when it was stored, and runs it now.
bool isWantedAgain(const PlannedRun& run, const StoredRun& stored) {
    return run.skip.empty() && stored.status == RunStatus::skipped && stored.reason.starts_with(leftOut);
}

/// The runs of the plan to do; counts the others in `result`.
std::vector<const PlannedRun*> chooseRuns(const std::vector<PlannedRun>& plan, const ResultsFolder& results,
                                          const ExecutionOptions& options, ExecutionResult& result) {
    Freshness freshness;
    std::vector<const PlannedRun*> toDo;
    for (const PlannedRun& run : plan) {
        const auto found = results.runs().find(runId(run.spec));
        if (found == results.runs().end() || options.force || isWantedAgain(run, found->second) ||
            (options.retryFailed && isFailure(found->second.status))) {
            toDo.push_back(&run);
            continue;
        }
        const std::string why = freshness.whyOutdated(found->second);
        if (!why.empty() && options.redoOutdated) {
            toDo.push_back(&run);
            continue;
        }
        ++result.kept;
        if (isFailure(found->second.status)) ++result.failed;
        if (why.empty()) continue;
        if (result.outdated++ == 0) result.whyOutdated = found->first + ": " + why;
    }
    return toDo;
}

/// False if interrupted.
bool coolDown(const ExecutionOptions& options, ExecutionListener& listener) {
    const auto total = static_cast<std::int64_t>(options.cooldownSeconds * 10);
    for (std::int64_t done = 0; done < total; ++done) {
        if (options.interrupted && options.interrupted()) return false;
        listener.heard(fmt::format("cooldown {} {}", done, total));
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return true;
}

/// Stores a run without results: its reason and its log.
void keepReason(const fs::path& folder, const RunSpec& spec, RunStatus status, const std::string& reason,
                const ExecutionOptions& options) {
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename() != "log.txt") fs::remove_all(entry.path());
    RunRecord record;
    record.spec = spec;
    record.drive = spec.drive;
    record.status = status;
    record.reason = reason;
    record.outputs.emplace();
    record.provenance = startProvenance(options.argv);
    record.summary = identityColumns(record, spec.threads == 0 ? record.provenance.machine.cores : spec.threads);
    writeWhole(folder / "run.json", toJson(record));
}

struct Outcome {
    RunStatus status = RunStatus::done;
    std::string reason;
    bool aborted = false;
};

constexpr int aborted = 2, badInput = 3;  // exit codes of a run's process

/// The process's last line, without the program's name.
std::string wordsOf(const ChildOutcome& outcome, std::string_view prefix) {
    const std::string& words = outcome.lastWords;
    return words.starts_with(prefix) ? words.substr(prefix.size()) : words;
}

/// Throws MachineError if that is why the process ended.
void requireMachine(const ChildOutcome& outcome, const ResourceLimits& limits) {
    if (outcome.end != ChildOutcome::End::exited || outcome.code != aborted) return;
    const std::string what = wordsOf(outcome, "dustbench: aborted: ");
    if (limits.memoryMegabytes > 0 && what.starts_with(files::outOfMemory)) return;  // its own limit
    throw files::MachineError(what.empty() ? "a run gave up without a word" : what);
}

std::string reasonOf(const ChildOutcome& outcome, const ResourceLimits& limits) {
    if (outcome.end == ChildOutcome::End::exited && outcome.code == aborted)
        return fmt::format("needs more than {} MB of memory (memory_limit_mb)", limits.memoryMegabytes);
    if (outcome.end == ChildOutcome::End::killedBySignal && outcome.code == SIGXCPU && limits.cpuSeconds > 0)
        return fmt::format("needs more than {} s of processor time (cpu_limit_s)", limits.cpuSeconds);
    return outcome.reason();
}

/// Why the record that a process left is not that of the run; empty if it is.
std::string faultOf(const fs::path& folder, const std::string& id) {
    if (!fs::exists(folder / "run.json")) return "ended without a result";
    try {
        const std::string got = readRunFile(folder / "run.json").runId;
        return got == id ? "" : fmt::format("left the result of another run, '{}'", got);
    } catch (const InputError& error) {
        return fmt::format("left a result that cannot be read: {}", error.what());
    }
}

Outcome runOne(const PlannedRun& run, ResultsFolder& results, const ExecutionOptions& options,
               ExecutionListener& listener) {
    const std::string id = runId(run.spec);
    requireRoom(results, maximumBytesOf(run.spec) + reserveBytes);
    const fs::path folder = results.beginRun(id);
    if (!run.skip.empty()) {
        keepReason(folder, run.spec, RunStatus::skipped, std::string(leftOut) + run.skip, options);
        results.publish(id);
        return {RunStatus::skipped, results.runs().at(id).reason, false};
    }
    const fs::path specFile = folder / "spec.json";
    writeWhole(specFile, specToJson(run.spec));

    std::string progress;
    ChildCommand command;
    command.argv = options.command(specFile, folder);
    command.log = folder / "log.txt";
    command.timeoutSeconds = options.timeoutSeconds;
    command.limits = options.limits;
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
    requireMachine(outcome, options.limits);
    if (options.badInputEnds && outcome.end == End::exited && outcome.code == badInput)
        throw InputError(outcome.lastWords.empty() ? "the run ended with exit code 3 and without a word"
                                                   : wordsOf(outcome, "dustbench: "));

    if (!fs::exists(specFile)) throw cannotWrite(folder, "it was removed while a run was being written there");
    fs::remove(specFile);
    // A full disk is not a result of the run.
    if (!outcome.succeeded()) {
        requireRoom(results, reserveBytes);
        requireWritable(folder);
    }
    const std::string fault = outcome.succeeded() ? faultOf(folder, id) : reasonOf(outcome, options.limits);
    if (!fault.empty()) {
        const RunStatus status = outcome.end == End::timedOut ? RunStatus::timeout : RunStatus::failed;
        std::string reason = fault;
        if (status == RunStatus::timeout) reason += progress.empty() ? "" : " (at " + progress + ")";
        keepReason(folder, run.spec, status, reason, options);
    } else if (fs::file_size(command.log) == 0) {
        fs::remove(command.log);
    }
    results.publish(id);
    const StoredRun& stored = results.runs().at(id);
    return {stored.status, stored.reason, false};
}

}  // namespace

std::vector<const PlannedRun*> runsToDo(const std::vector<PlannedRun>& plan, const ResultsFolder& results,
                                        const ExecutionOptions& options) {
    ExecutionResult counts;
    return chooseRuns(plan, results, options, counts);
}

ExecutionResult execute(const std::vector<PlannedRun>& plan, int repetitions, ResultsFolder& results,
                        const ExecutionOptions& options, ExecutionListener& listener) {
    using Clock = std::chrono::steady_clock;
    ExecutionResult result;
    const std::vector<const PlannedRun*> toDo = chooseRuns(plan, results, options, result);
    RemainingTime remaining(toDo, options.forecasts, options.cooldownSeconds);
    for (const PlannedRun* run : toDo) {
        listener.started(static_cast<std::size_t>(run - plan.data()) + 1, plan.size(), *run, repetitions,
                         remaining.seconds());
        const auto start = Clock::now();
        result.aborted = run != toDo.front() && !coolDown(options, listener);
        if (result.aborted) break;
        const Outcome outcome = [&] {
            try {
                return runOne(*run, results, options, listener);
            } catch (const fs::filesystem_error& failure) {
                results.discard(runId(run->spec));
                files::failWriting(results.path(), failure.code().value());
            } catch (...) {
                results.discard(runId(run->spec));
                throw;
            }
        }();
        result.aborted = outcome.aborted;
        if (result.aborted) break;
        listener.ended(*run, outcome.status, outcome.reason);
        remaining.ended(std::chrono::duration<double>(Clock::now() - start).count());
        if (isFailure(outcome.status))
            ++result.failed;
        else
            ++(outcome.status == RunStatus::skipped ? result.skipped : result.done);
    }
    results.writeSummary();
    return result;
}

}  // namespace dustbench::bench
