#include "bench/run/executor.h"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <list>
#include <memory>
#include <optional>
#include <thread>

#include "bench/results/freshness.h"
#include "bench/results/output_files.h"
#include "bench/results/summary.h"
#include "bench/run/child_process.h"
#include "bench/run/run_forecast.h"
#include "bench/run/run_messages.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::run {
namespace fs = std::filesystem;
namespace {

bool isFailure(results::RunStatus status) {
    return status == results::RunStatus::failed || status == results::RunStatus::timeout;
}

/// Space to keep free for tables and logs.
constexpr std::uint64_t reserveBytes = 16 << 20;

void requireRoom(const results::ResultsFolder& results, std::uint64_t bytes) {
    const std::uint64_t free = results::freeBytes(results.path());
    if (free < bytes)
        throw files::MachineError(
            fmt::format("output '{}' cannot be written: the disk has {} free and the next run may "
                        "need {}",
                        results.path().string(), results::bytesText(free), results::bytesText(bytes)));
}

/// Writes a file of one MiB: the only check for quotas and free inodes that works on every file system.
void requireWritable(const fs::path& folder) {
    exports::writeWhole(folder / "probe", std::string(std::size_t{1} << 20, 'x'));
    fs::remove(folder / "probe");
}

/// Prefix of the reason of runs that a suite excludes; a later suite may run them.
constexpr std::string_view leftOut = "left out by the suite: ";

/// True if the suite excluded the run when it was stored and includes it now.
bool isWantedAgain(const suite::PlannedRun& run, const results::StoredRun& stored) {
    return run.skip.empty() && stored.status == results::RunStatus::skipped && stored.reason.starts_with(leftOut);
}

/// The runs of the plan that must be done; counts the others in `result`.
std::vector<const suite::PlannedRun*> chooseRuns(const std::vector<suite::PlannedRun>& plan,
                                                 const results::ResultsFolder& results, const ExecutionOptions& options,
                                                 ExecutionResult& result) {
    results::Freshness freshness;
    std::vector<const suite::PlannedRun*> toDo;
    for (const suite::PlannedRun& run : plan) {
        const auto found = results.runs().find(results::runId(run.spec));
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
        listener.progressed(fmt::format("cooldown {} {}", done, total));
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return true;
}

/// Stores a run without results: the reason and the log.
void keepReason(const fs::path& folder, const results::RunSpec& spec, results::RunStatus status,
                const std::string& reason, const ExecutionOptions& options) {
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename() != "log.txt") fs::remove_all(entry.path());
    results::RunRecord record;
    record.spec = spec;
    record.drive = spec.drive;
    record.status = status;
    record.reason = reason;
    record.outputs.emplace();
    record.provenance = measure::startProvenance(options.argv);
    record.summary =
        results::identityColumns(record, spec.threads == 0 ? record.provenance.machine.cores : spec.threads);
    exports::writeWhole(folder / "run.json", results::toJson(record));
}

/// True if the run needed more memory than its own limit.
bool exceedsMemoryLimit(const RunError& error, const suite::ResourceLimits& limits) {
    return error.kind == RunError::Kind::memory && limits.memoryMegabytes > 0;
}

/// Throws what concerns the whole plan: MachineError if the machine lacked something; InputError if `badInputEnds`.
void requireOtherRunsPossible(const RunError& error, const ExecutionOptions& options) {
    using Kind = RunError::Kind;
    if (error.kind == Kind::input && options.badInputEnds) throw InputError(error.message);
    if (error.kind == Kind::machine || (error.kind == Kind::memory && !exceedsMemoryLimit(error, options.limits)))
        throw files::MachineError(error.message);
}

std::string reasonOf(const ChildOutcome& outcome, const std::optional<RunError>& error,
                     const suite::ResourceLimits& limits) {
    if (error && exceedsMemoryLimit(*error, limits))
        return fmt::format("exceeds the memory limit of {} MB (memory_limit_mb)", limits.memoryMegabytes);
    if (outcome.end == ChildOutcome::End::killedBySignal && outcome.code == SIGXCPU && limits.cpuSeconds > 0)
        return fmt::format("exceeds the limit of {} s of processor time (cpu_limit_s)", limits.cpuSeconds);
    return outcome.reason();
}

/// Why the record written by a process is not that of the run; empty if it is.
std::string faultOf(const fs::path& folder, const std::string& id) {
    if (!fs::exists(folder / "run.json")) return "ended without a result";
    try {
        const std::string got = results::readRunFile(folder / "run.json").runId;
        return got == id ? "" : fmt::format("wrote the result of another run, '{}'", got);
    } catch (const InputError& error) {
        return fmt::format("wrote a result that cannot be read: {}", error.what());
    }
}

/// One run of the plan, from its folder to its result. Without `finish`, its folder is removed.
class RunInProgress {
 public:
    using Clock = std::chrono::steady_clock;

    /// `position`: in the list of runs to do.
    RunInProgress(const suite::PlannedRun& run, std::size_t position, results::ResultsFolder& results,
                  const ExecutionOptions& options, ExecutionListener& listener)
        : run_(run), position_(position), id_(results::runId(run.spec)), results_(results), options_(options) {
        requireRoom(results, results::maximumBytesOf(run.spec) + reserveBytes);
        folder_ = results.beginRun(id_);
        try {
            start(listener);
        } catch (...) {
            results.discard(id_);
            throw;
        }
    }
    ~RunInProgress() {
        child_.reset();
        if (!finished_) results_.discard(id_);
    }
    RunInProgress(const RunInProgress&) = delete;
    RunInProgress& operator=(const RunInProgress&) = delete;

    [[nodiscard]] const suite::PlannedRun& run() const { return run_; }
    [[nodiscard]] std::size_t position() const { return position_; }
    [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    /// True once the process has ended.
    [[nodiscard]] bool advance(std::chrono::milliseconds atMost) { return !child_ || child_->advance(atMost); }
    /// Publishes the result, or the reason why there is none. Returns nothing if the run was interrupted.
    [[nodiscard]] std::optional<results::StoredRun> finish() {
        if (child_ && child_->outcome().end == ChildOutcome::End::interrupted) return std::nullopt;
        if (child_) keep(child_->outcome());
        results_.publish(id_);
        finished_ = true;
        return results_.runs().at(id_);
    }

 private:
    void start(ExecutionListener& listener) {
        if (!run_.skip.empty()) {
            keepReason(folder_, run_.spec, results::RunStatus::skipped, std::string(leftOut) + run_.skip, options_);
            return;
        }
        exports::writeWhole(specFile(), results::specToJson(run_.spec));
        ChildCommand command;
        command.argv = options_.command(specFile(), folder_);
        command.log = log();
        command.timeoutSeconds = options_.timeoutSeconds;
        command.limits = options_.limits;
        command.interrupted = options_.interrupted;
        command.onLine = [this, &listener](std::string_view line) {
            if (auto error = errorIn(line)) {
                error_ = std::move(error);
                return;
            }
            if (!line.empty()) progress_ = line;
            listener.progressed(line);
        };
        child_ = std::make_unique<ChildProcess>(std::move(command));
    }
    [[nodiscard]] fs::path specFile() const { return folder_ / "spec.json"; }
    [[nodiscard]] fs::path log() const { return folder_ / "log.txt"; }

    void keep(const ChildOutcome& outcome) {
        if (error_ && outcome.end == ChildOutcome::End::exited) requireOtherRunsPossible(*error_, options_);

        if (!fs::exists(specFile()))
            throw exports::cannotWrite(folder_, "it was removed while a run was being written there");
        fs::remove(specFile());
        // A full disk is not a result of the run.
        if (!outcome.succeeded()) {
            requireRoom(results_, reserveBytes);
            requireWritable(folder_);
        }
        const std::string fault =
            outcome.succeeded() ? faultOf(folder_, id_) : reasonOf(outcome, error_, options_.limits);
        if (!fault.empty()) {
            const results::RunStatus status =
                outcome.end == ChildOutcome::End::timedOut ? results::RunStatus::timeout : results::RunStatus::failed;
            std::string reason = fault;
            if (status == results::RunStatus::timeout) reason += progress_.empty() ? "" : " (at " + progress_ + ")";
            keepReason(folder_, run_.spec, status, reason, options_);
        } else if (fs::file_size(log()) == 0) {
            fs::remove(log());
        }
    }

    const suite::PlannedRun& run_;
    std::size_t position_;
    std::string id_;
    results::ResultsFolder& results_;
    const ExecutionOptions& options_;
    fs::path folder_;
    std::string progress_;           ///< last progress line of the process
    std::optional<RunError> error_;  ///< why the process ended
    Clock::time_point start_ = Clock::now();
    std::unique_ptr<ChildProcess> child_;  ///< none if the suite excludes the run
    bool finished_ = false;
};

/// Executes a list of runs, several at a time if requested.
class Execution {
 public:
    Execution(const std::vector<suite::PlannedRun>& plan, const std::vector<const suite::PlannedRun*>& toDo,
              results::ResultsFolder& results, const ExecutionOptions& options, ExecutionListener& listener,
              ExecutionResult& result)
        : plan_(plan),
          toDo_(toDo),
          results_(results),
          options_(options),
          listener_(listener),
          result_(result),
          remaining_(toDo, options.forecasts, options.cooldownSeconds) {}

    void run(int repetitions) {
        while (true) {
            while (!result_.aborted && next_ < toDo_.size() &&
                   static_cast<int>(running_.size()) < std::max(options_.simultaneous, 1))
                start(repetitions);
            if (running_.empty()) break;
            const std::chrono::milliseconds share(100 / static_cast<int>(running_.size()));
            for (auto each = running_.begin(); each != running_.end();)
                each = (*each)->advance(share) ? finish(each) : std::next(each);
        }
    }

 private:
    using Running = std::list<std::unique_ptr<RunInProgress>>;

    void start(int repetitions) {
        const suite::PlannedRun& run = *toDo_[next_];
        listener_.started(static_cast<std::size_t>(&run - plan_.data()) + 1, plan_.size(), run, repetitions,
                          remaining_.seconds() / std::max(options_.simultaneous, 1));
        if (next_ > 0 && !coolDown(options_, listener_)) {
            result_.aborted = true;
            return;
        }
        running_.push_back(std::make_unique<RunInProgress>(run, next_, results_, options_, listener_));
        ++next_;
    }

    Running::iterator finish(Running::iterator each) {
        RunInProgress& run = **each;
        if (const std::optional<results::StoredRun> stored = run.finish()) {
            listener_.ended(run.run(), stored->status, stored->reason);
            remaining_.ended(run.position(), run.seconds() + (run.position() > 0 ? options_.cooldownSeconds : 0));
            if (isFailure(stored->status))
                ++result_.failed;
            else
                ++(stored->status == results::RunStatus::skipped ? result_.skipped : result_.done);
        } else {
            result_.aborted = true;
        }
        return running_.erase(each);
    }

    const std::vector<suite::PlannedRun>& plan_;
    const std::vector<const suite::PlannedRun*>& toDo_;
    results::ResultsFolder& results_;
    const ExecutionOptions& options_;
    ExecutionListener& listener_;
    ExecutionResult& result_;
    RemainingTime remaining_;
    std::size_t next_ = 0;
    Running running_;
};

}  // namespace

std::vector<const suite::PlannedRun*> runsToDo(const std::vector<suite::PlannedRun>& plan,
                                               const results::ResultsFolder& results, const ExecutionOptions& options) {
    ExecutionResult counts;
    return chooseRuns(plan, results, options, counts);
}

ExecutionResult execute(const std::vector<suite::PlannedRun>& plan, int repetitions, results::ResultsFolder& results,
                        const ExecutionOptions& options, ExecutionListener& listener) {
    ExecutionResult result;
    const std::vector<const suite::PlannedRun*> toDo = chooseRuns(plan, results, options, result);
    try {
        Execution(plan, toDo, results, options, listener, result).run(repetitions);
    } catch (const fs::filesystem_error& failure) {
        files::failWriting(results.path(), failure.code().value());
    }
    if (!result.aborted || !results.runs().empty()) results.writeSummary();
    return result;
}

}  // namespace dustbench::run
