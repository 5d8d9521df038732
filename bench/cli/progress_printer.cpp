#include "bench/cli/progress_printer.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>

#include "bench/run/progress.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

/// Limits output to plain logs to one line per interval instead of one per frame.
constexpr std::chrono::seconds plainInterval{30};
constexpr std::chrono::milliseconds barInterval{100};

}  // namespace

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

void ProgressPrinter::started(std::size_t position, std::size_t total, const bench::PlannedRun& run, int repetitions,
                              double etaSeconds) {
    const auto text = terminal_ ? bench::progressLine : bench::progressSentence;
    std::cerr << files::printable(text(position, total, run, repetitions, etaSeconds)) << std::endl;
    last_.clear();
    lastShown_ = phaseStart_ = std::chrono::steady_clock::now();
}

void ProgressPrinter::progressed(std::string_view line) {
    if (!showsSteps_) return;
    const auto now = std::chrono::steady_clock::now();
    if (!line.empty()) {
        if (bench::phaseOf(line) != bench::phaseOf(last_)) phaseStart_ = now;
        last_ = line;
    }
    if (terminal_ && now - lastShown_ >= barInterval) {
        eraseBar();
        std::cerr << files::printable(bench::progressBar(last_, terminalWidth(), phaseSeconds(now))) << std::flush;
    } else if (!terminal_ && now - lastShown_ >= plainInterval) {
        std::cerr << "    "
                  << (last_.empty() ? "starting" : files::printable(bench::phaseSentence(last_, phaseSeconds(now))))
                  << std::endl;
    } else {
        return;
    }
    lastShown_ = now;
}

void ProgressPrinter::ended(const bench::PlannedRun&, bench::RunStatus status, const std::string& reason) {
    eraseBar();
    if (status != bench::RunStatus::done)
        std::cerr << "    " << bench::runStatuses.wordOf(status) << ": " << files::printable(reason) << std::endl;
}

}  // namespace dustbench::cli
