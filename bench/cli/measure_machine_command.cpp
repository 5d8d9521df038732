// `dustbench measure-machine`: how fast is this machine? Self-check, suites as far as time and memory allow, page and
// bundle.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/shared_options.h"
#include "bench/export/whole_file.h"
#include "bench/measure/clock_watch.h"
#include "bench/report/page.h"
#include "bench/report/report_reader.h"
#include "bench/results/run_tables.h"
#include "bench/run/child_process.h"
#include "bench/run/progress.h"
#include "bench/selfcheck/selfcheck_report.h"
#include "bench/suite/bundle/bundle.h"
#include "bench/suite/machine/machine_plan.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/memory/available_memory.h"

namespace dustbench::cli {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

struct MeasureMachineOptions {
    std::string out;
    bool quick = false;
};

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Shows each run with its place among all cells, of which the executor sees one at a time. The time left is unknown:
/// it depends on the loads that fit.
class PlacedProgress final : public ProgressPrinter {
 public:
    void place(std::size_t position, std::size_t total) {
        position_ = position;
        total_ = total;
    }
    void started(std::size_t, std::size_t, const suite::PlannedRun& run, int repetitions, double) override {
        ProgressPrinter::started(position_, total_, run, repetitions, -1);
    }

 private:
    std::size_t position_ = 0, total_ = 0;
};

suite::LadderLimits limitsHere(const suite::MachinePlan& plan) {
    const gpu::Device device;
    suite::LadderLimits limits = device.isSoftware() ? plan.software : plan.hardware;
    limits.hostBytes = plan.memoryShare * static_cast<double>(availableBytes());
    if (const auto free = device.driverFreeBytes()) limits.deviceBytes = plan.memoryShare * static_cast<double>(*free);
    std::cerr << fmt::format("{}: at most {}\n", files::printable(device.info().renderer),
                             run::durationText(limits.totalSeconds));
    return limits;
}

/// The self-check in a process of its own, which a faulty driver may crash.
class SelfCheck {
 public:
    /// Keeps the result of an earlier call in `folder`.
    explicit SelfCheck(const fs::path& folder) : folder_(folder) {}

    /// False if it was interrupted.
    [[nodiscard]] bool run() {
        if (fs::exists(folder_ / "selfcheck.json")) return true;
        std::cerr << "self-check" << std::endl;
        const Clock::time_point start = Clock::now();
        const fs::path log = folder_ / "selfcheck.log";
        run::ChildCommand command;
        command.argv = {"/proc/self/exe", "selfcheck", "--out", folder_.string()};
        command.log = log;
        command.timeoutSeconds = 600;
        command.onLine = [](std::string_view) {};
        command.interrupted = [] { return interrupted(); };
        const run::ChildOutcome outcome = run::runChild(command);
        seconds_ = secondsSince(start);
        if (outcome.end == run::ChildOutcome::End::interrupted) return false;
        if (fs::exists(folder_ / "selfcheck.json"))
            fs::remove(log);
        else
            crash_ = "self-check: " + outcome.reason();
        return true;
    }
    [[nodiscard]] double seconds() const { return seconds_; }
    /// One sentence for each failure.
    [[nodiscard]] std::vector<std::string> problems() const {
        return crash_.empty() ? selfcheck::selfcheckProblems(folder_) : std::vector{crash_};
    }

 private:
    fs::path folder_;
    double seconds_ = 0;
    std::string crash_;
};

bool clockFell(const results::StoredRun& run) {
    return std::ranges::any_of(run.warnings, measure::saysClockFell);
}

/// Runs the ladder. Existing results count with the time that they took.
class MachineMeasurement {
 public:
    MachineMeasurement(const suite::MachinePlan& plan, const suite::LadderLimits& limits,
                       results::ResultsFolder& results, double elapsedSeconds)
        : cells_(suite::cellsOf(plan)),
          limits_(limits),
          ladder_(laddersOf(cells_), limits),
          results_(results),
          elapsed_(elapsedSeconds),
          execution_(childExecution()) {}

    /// False if it was interrupted.
    [[nodiscard]] bool run() {
        while (const auto step = ladder_.next(elapsed_)) {
            suite::PlannedRun run = cells_[step->cell].run;
            run.spec = suite::inRepetition(run.spec, step->repetition);
            run.skip = step->skip;
            if (!measure(run, *step)) return false;
        }
        progress_.eraseBar();
        return true;
    }

    [[nodiscard]] bool anyDone() const { return done_ > 0; }
    [[nodiscard]] bool anyFailed() const { return failed_ > 0; }

    void printSummary() const {
        std::cerr << fmt::format("{} runs done in {}, {} left out, {} failed\n", done_, run::durationText(elapsed_),
                                 leftOut_, failed_);
        if (ladder_.repetitionsLeftOut() > 0)
            std::cerr << fmt::format("{} further repetitions did not fit into {}\n", ladder_.repetitionsLeftOut(),
                                     run::durationText(limits_.totalSeconds));
        if (slowed_ > 0)
            std::cerr << fmt::format(
                "runs whose clock fell, even when they were measured again: {}; see their warnings\n", slowed_);
        if (!outdated_.empty())
            std::cerr << "outdated: another build measured some of the results; measure into a new folder ("
                      << files::printable(outdated_) << ")\n";
    }

 private:
    static std::vector<suite::LadderCell> laddersOf(const std::vector<suite::PlacedCell>& cells) {
        std::vector<suite::LadderCell> ladders;
        ladders.reserve(cells.size());
        for (const suite::PlacedCell& cell : cells) ladders.push_back(cell.ladder);
        return ladders;
    }

    bool measure(const suite::PlannedRun& run, const suite::LadderStep& step) {
        const suite::LadderCell& cell = cells_[step.cell].ladder;
        position_ = ++positions_[step.repetition];
        const Clock::time_point start = Clock::now();
        bool isNew = false;
        if (!execute(run, cell, false, isNew)) return false;
        const std::string id = results::runId(run.spec);
        if (isNew && clockFell(results_.runs().at(id)) && !execute(run, cell, true, isNew)) return false;
        const results::StoredRun& stored = results_.runs().at(id);
        elapsed_ += isNew ? secondsSince(start) : suite::needsOf(stored, run.spec).allSeconds();
        count(stored, run, step);
        return true;
    }

    bool execute(const suite::PlannedRun& run, const suite::LadderCell& cell, bool again, bool& isNew) {
        const double allowed = limits_.runSeconds + (run.spec.metricPlan ? limits_.metricSeconds : 0);
        execution_.timeoutSeconds = 2 * allowed;
        execution_.force = again;
        progress_.place(position_, cells_.size());
        const run::ExecutionResult result = run::execute({run}, cell.repetitions, results_, execution_, progress_);
        if (outdated_.empty()) outdated_ = result.whyOutdated;
        isNew = result.kept == 0;
        return !result.aborted;
    }

    void count(const results::StoredRun& stored, const suite::PlannedRun& run, const suite::LadderStep& step) {
        using Status = results::RunStatus;
        if (stored.status == Status::done) {
            ++done_;
            if (clockFell(stored)) ++slowed_;
            if (step.skip.empty()) ladder_.done(step, suite::needsOf(stored, run.spec));
            return;
        }
        ++(stored.status == Status::failed ? failed_ : leftOut_);
        if (step.skip.empty()) ladder_.failed(step);
    }

    std::vector<suite::PlacedCell> cells_;
    suite::LadderLimits limits_;
    suite::LoadLadder ladder_;
    results::ResultsFolder& results_;
    double elapsed_;
    run::ExecutionOptions execution_;
    PlacedProgress progress_;
    std::size_t position_ = 0, done_ = 0, leftOut_ = 0, failed_ = 0, slowed_ = 0;
    std::map<int, std::size_t> positions_;  ///< by repetition
    std::string outdated_;
};

/// The bundle of folder DIR: `DIR.tar`.
fs::path bundleOf(const fs::path& out) {
    fs::path folder = out.lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();
    if (folder.empty() || folder == "." || folder.filename() == "..") folder = fs::absolute(out).lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();
    return folder += ".tar";
}

/// Writes the tables, which are small enough for a repository.
void writeTables(const results::ResultsFolder& results) {
    const fs::path tables = results.path() / "tables";
    std::error_code error;
    fs::create_directories(tables, error);
    if (error) files::failWriting(tables.string(), error.value());
    exports::writeWhole(tables / "summary.csv", results::summaryCsv(results.runs()));
    exports::writeWhole(tables / "runs.csv", results::runsCsv(results.runs()));
    exports::writeWhole(tables / "machine.csv", results::machineCsv(results.runs()));
    if (const fs::path found = results.path() / "selfcheck.json"; fs::exists(found))
        fs::copy_file(found, tables / "selfcheck.json", fs::copy_options::overwrite_existing);
}

void writeResults(const results::ResultsFolder& results) {
    const fs::path archive = bundleOf(results.path());
    writeTables(results);
    std::cout << (results.path() / "tables").string() << "\n";
    const report::ReportData report = report::readReport(results.path(), report::defaultPictureBytes);
    std::cout << report::writePage(results.path(), report).string() << "  (open it in a browser)\n" << std::flush;
    for (const std::string& missing : suite::packBundle(results.path(), archive).missing)
        std::cerr << "note: " << files::printable(missing) << "\n";
    std::cout << archive.string() << "  (send this)\n";
}

int measureMachine(const MeasureMachineOptions& options) {
    const suite::MachinePlan plan = suite::loadMachinePlan(options.quick);
    std::vector<suite::PlannedRun> runs;
    for (suite::PlacedCell& cell : suite::cellsOf(plan)) runs.push_back(std::move(cell.run));
    checkWorlds(runs);
    const fs::path out(options.out), archive = bundleOf(out);
    if (fs::exists(fs::symlink_status(archive)) && !fs::exists(out / "runs"))
        throw InputError(fmt::format("bundle '{}': already exists and does not belong to '{}'; choose another --out",
                                     archive.string(), out.string()));
    if (fs::is_directory(out)) report::requireOwnPage(out);
    const suite::LadderLimits limits = limitsHere(plan);
    results::ResultsFolder results(out);
    listenForInterruption();
    SelfCheck check(out);
    const auto aborted = [] {
        std::cerr << "aborted; the same command resumes" << std::endl;
        return exitAborted;
    };
    if (!check.run()) return aborted();
    MachineMeasurement measurement(plan, limits, results, check.seconds());
    if (!measurement.run()) return aborted();
    measurement.printSummary();
    if (measurement.anyDone()) writeResults(results);
    const std::vector<std::string> problems = check.problems();
    for (const std::string& problem : problems) std::cerr << "dustbench: " << files::printable(problem) << std::endl;
    return problems.empty() && measurement.anyDone() && !measurement.anyFailed() ? exitOk : exitRunFailed;
}

}  // namespace

Command measureMachineCommand() {
    auto options = std::make_shared<MeasureMachineOptions>();
    return {
        "measure-machine", "Measure how fast this machine is: error and time of every method, in one bundle",
        "Takes at most 10 minutes on a GPU, 30 without one: self-check, then each method from 1,000 particles up at\n"
        "three sizes, the fluid and ray casts, as far as time and memory allow. Runs that are left out are recorded\n"
        "with the reason. Writes DIR/index.html, DIR/tables and the bundle DIR.tar. The same command resumes.\n"
        "Exit code 1: a check or a run failed.",
        [options](Arguments& arguments) {
            arguments.required("--out", "DIR", "folder for the results; created if missing", options->out);
            arguments.flag("--quick", "a few seconds of tiny runs, to try the command", options->quick);
        },
        [options] { return measureMachine(*options); }};
}

}  // namespace dustbench::cli
