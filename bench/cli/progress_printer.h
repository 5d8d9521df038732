// Shows the progress of a plan on stderr: a bar on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <string>

#include "bench/run/executor.h"

namespace dustbench::cli {

class ProgressPrinter : public bench::ExecutionListener {
 public:
    /// `showsSteps`: show the progress within a run, if only one runs at a time.
    explicit ProgressPrinter(bool showsSteps = true);

    void started(std::size_t position, std::size_t total, const bench::PlannedRun& run, int repetitions,
                 double etaSeconds) override;
    void progressed(std::string_view line) override;
    void ended(const bench::PlannedRun& run, bench::RunStatus status, const std::string& reason) override;
    /// Call before printing anything else.
    void eraseBar();

 private:
    [[nodiscard]] int terminalWidth() const;
    [[nodiscard]] double phaseSeconds(std::chrono::steady_clock::time_point now) const;

    bool terminal_, showsSteps_;
    std::string last_;                                  ///< the run's last message
    std::chrono::steady_clock::time_point phaseStart_;  ///< start of the run's current phase
    std::chrono::steady_clock::time_point lastShown_;
};

}  // namespace dustbench::cli
