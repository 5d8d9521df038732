#include "bench/cli/plan_runner.h"

#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <initializer_list>
#include <iostream>
#include <string_view>
#include <thread>

#include "bench/cli/commands.h"
#include "bench/measure/provenance.h"
#include "bench/results/stored_run.h"
#include "bench/run/progress.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::cli {
namespace {

/// Number of simultaneous runs: one if any run's times are measured, otherwise one per core.
int simultaneousOf(const std::vector<suite::PlannedRun>& plan) {
    const bool isTimed = std::ranges::any_of(plan, [](const suite::PlannedRun& run) { return run.spec.timed; });
    return isTimed ? 1 : static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
}

run::ExecutionOptions executionOf(const std::vector<suite::PlannedRun>& plan, const PlanOptions& options) {
    run::ExecutionOptions execution = childExecution();
    execution.simultaneous = simultaneousOf(plan);
    execution.force = options.force;
    execution.retryFailed = options.retryFailed;
    execution.redoOutdated = options.redoOutdated;
    execution.timeoutSeconds = options.timeoutSeconds;
    execution.limits = options.limits;
    execution.cooldownSeconds = options.cooldownSeconds;
    execution.badInputEnds = options.badInputEnds;
    execution.forecasts = options.forecasts;
    return execution;
}

/// Limits output to plain logs to one line per interval instead of one per frame.
constexpr std::chrono::seconds plainInterval{30};
constexpr std::chrono::milliseconds barInterval{100};

volatile sig_atomic_t interruptions = 0;

void countInterruption(int) {
    interruptions = interruptions + 1;
}

/// Calls only functions that are safe in a signal handler.
void endAtOnce(int) {
    constexpr std::string_view message = "aborted; repeat the command to resume\n";
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message.data(), message.size());
    _exit(exitAborted);
}

void handleBy(void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    for (const int signalNumber : {SIGINT, SIGTERM, SIGHUP}) sigaction(signalNumber, &action, nullptr);
}

}  // namespace

run::ExecutionOptions childExecution() {
    listenForInterruption();
    run::ExecutionOptions execution;
    execution.argv = measure::commandLine();
    execution.interrupted = [] { return interrupted(); };
    const auto calling = [argv = execution.argv](const char* name) -> run::ChildCommandLine {
        return [argv, name](const std::filesystem::path& spec, const std::filesystem::path& folder) {
            std::vector<std::string> command{"/proc/self/exe", name, spec.string(), folder.string(), "--"};
            command.insert(command.end(), argv.begin(), argv.end());
            return command;
        };
    };
    execution.command = calling(measureRunName);
    execution.forecastCommand = calling(forecastRunName);
    return execution;
}

void requireOpenGl() {
    const gpu::Device mustExist;
}

run::PlanForecast forecastRuns(const std::vector<suite::PlannedRun>& plan, results::ResultsFolder& results,
                               PlanOptions& options) {
    run::ExecutionOptions execution = executionOf(plan, options);
    ProgressPrinter printer;
    run::PlanForecast forecast = run::forecastPlan(plan, results, execution, printer);
    printer.eraseBar();
    options.forecasts = std::move(execution.forecasts);
    return forecast;
}

int runPlan(const std::vector<suite::PlannedRun>& plan, int repetitions, results::ResultsFolder& results,
            const PlanOptions& options) {
    const run::ExecutionOptions execution = executionOf(plan, options);
    for (const std::string& sentence : results.setAside())
        std::cerr << "warning: " << files::printable(sentence) << std::endl;
    if (const std::string said = results::saysNothingOfOutputs(results.runs()); !said.empty())
        std::cerr << "warning: " << said << std::endl;
    ProgressPrinter printer(execution.simultaneous == 1);
    const run::ExecutionResult result = run::execute(plan, repetitions, results, execution, printer);
    if (result.aborted) {
        std::cerr << "aborted; repeat the command to resume" << std::endl;
        return exitAborted;
    }
    if (plan.size() > 1)
        std::cerr << result.done << " done, " << result.skipped << " skipped, " << result.failed << " failed, "
                  << result.kept << " existing" << std::endl;
    else if (result.kept > 0)
        std::cerr << "the result already exists; --force measures it again" << std::endl;
    if (result.outdated > 0)
        std::cerr << "outdated: " << result.outdated << " of the existing results; --redo-outdated re-runs them ("
                  << files::printable(result.whyOutdated) << ")" << std::endl;
    return result.failed > 0 ? exitRunFailed : exitOk;
}

ProgressPrinter::ProgressPrinter(bool showsSteps) : terminal_(isatty(STDERR_FILENO) != 0), showsSteps_(showsSteps) {}

int ProgressPrinter::terminalWidth() const {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void ProgressPrinter::eraseBar() {
    if (terminal_) std::cerr << "\r\x1b[K";
}

double ProgressPrinter::phaseSeconds(std::chrono::steady_clock::time_point now) const {
    return std::chrono::duration<double>(now - phaseStart_).count();
}

void ProgressPrinter::started(std::size_t position, std::size_t total, const suite::PlannedRun& run, int repetitions,
                              double etaSeconds) {
    const auto text = terminal_ ? run::progressLine : run::progressSentence;
    std::cerr << files::printable(text(position, total, run, repetitions, etaSeconds)) << std::endl;
    last_.clear();
    lastShown_ = phaseStart_ = std::chrono::steady_clock::now();
}

void ProgressPrinter::progressed(std::string_view line) {
    if (!showsSteps_) return;
    const auto now = std::chrono::steady_clock::now();
    if (!line.empty()) {
        if (run::phaseOf(line) != run::phaseOf(last_)) phaseStart_ = now;
        last_ = line;
    }
    if (terminal_ && now - lastShown_ >= barInterval) {
        eraseBar();
        std::cerr << files::printable(run::progressBar(last_, terminalWidth(), phaseSeconds(now))) << std::flush;
    } else if (!terminal_ && now - lastShown_ >= plainInterval) {
        std::cerr << "    "
                  << (last_.empty() ? "starting" : files::printable(run::phaseSentence(last_, phaseSeconds(now))))
                  << std::endl;
    } else {
        return;
    }
    lastShown_ = now;
}

void ProgressPrinter::ended(const suite::PlannedRun&, results::RunStatus status, const std::string& reason) {
    eraseBar();
    if (status != results::RunStatus::done)
        std::cerr << "    " << results::runStatuses.wordOf(status) << ": " << files::printable(reason) << std::endl;
}

void listenForInterruption() {
    handleBy(countInterruption);
}

EndsWhenInterrupted::EndsWhenInterrupted() {
    handleBy(endAtOnce);
    if (interrupted()) endAtOnce(SIGINT);
}

bool interrupted() {
    return interruptions != 0;
}

}  // namespace dustbench::cli
