// From the recorded frames of a run to its row of summary.csv. `reports/SCHEMA.md` defines every column.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/measure/frame_record.h"
#include "bench/results/run_record.h"

namespace dustbench::bench {

/// The columns of summary.csv before and after those of the parameters (`p.…`), in order.
[[nodiscard]] const std::vector<std::string>& columnsBeforeParameters();
[[nodiscard]] const std::vector<std::string>& columnsAfterParameters();

/// The cells that every run has, whatever became of it.
[[nodiscard]] Columns identityColumns(const RunRecord& record, int threads);

/// What is measured of a run as a whole; empty where the machine does not tell.
struct WholeRun {
    std::int64_t peakResidentBytes = 0;
    std::optional<std::int64_t> driverBytes;     ///< that went from the GPU's free memory since the run began
    std::optional<double> startSeconds;          ///< from the process's start to its first picture
    std::optional<double> cpuJoules, gpuJoules;  ///< over the recorded frames
    bool softwareRenderer = false;               ///< then the CPU's energy is all there is
};

/// The cells that the frames and the run as a whole give.
[[nodiscard]] Columns measuredColumns(std::span<const FrameRecord> frames, const WholeRun& run);

}  // namespace dustbench::bench
