// The tables of a run's recorded frames: its row of summary.csv, frames.csv and stages.csv. `reports/SCHEMA.md` defines
// every column.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/measure/frame_record.h"
#include "bench/results/run_record.h"

namespace dustbench::results {

/// The columns of summary.csv before and after the parameters (`p.…`), in order.
[[nodiscard]] const std::vector<std::string>& columnsBeforeParameters();
[[nodiscard]] const std::vector<std::string>& columnsAfterParameters();
/// The numeric columns after the parameters, which charts can show.
[[nodiscard]] const std::vector<std::string>& numericColumns();

/// Whether a column depends on the machine's speed (times, frame rates, energy). Runs without times lack such columns.
[[nodiscard]] bool dependsOnSpeed(std::string_view column);

/// The columns that every run has, whatever its status.
[[nodiscard]] Columns identityColumns(const RunRecord& record, int threads);

/// Measurements of a run as a whole; empty if not available on this machine.
struct WholeRun {
    std::int64_t peakResidentBytes = 0;
    std::optional<std::int64_t> driverBytes;     ///< decrease of the GPU's free memory since the start of the run
    std::optional<double> startSeconds;          ///< from the process's start to its first picture
    std::optional<double> cpuJoules, gpuJoules;  ///< over the recorded frames
    /// Lowest and highest clock of the GPU over the recorded frames.
    std::optional<std::pair<std::int64_t, std::int64_t>> gpuMegahertz{};
    bool softwareRenderer = false;  ///< if true, the CPU's energy is the total energy
};

/// The columns computed from the frames and the run as a whole.
[[nodiscard]] Columns measuredColumns(std::span<const measure::FrameRecord> frames, const WholeRun& run);

/// The text of frames.csv: one row per recorded frame.
[[nodiscard]] std::string framesCsv(std::span<const measure::FrameRecord> frames);

/// The text of stages.csv: `frame,stage,detail,ms`, one row per frame and finer stage.
[[nodiscard]] std::string stagesCsv(std::span<const measure::FrameRecord> frames);

}  // namespace dustbench::results
