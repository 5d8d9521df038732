// From the recorded frames of a run to its row of summary.csv. `reports/SCHEMA.md` defines every column.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/measure/frame_record.h"
#include "bench/run/run_record.h"

namespace dustbench::bench {

/// The columns of summary.csv before and after those of the parameters (`p.…`), in order.
[[nodiscard]] const std::vector<std::string>& columnsBeforeParameters();
[[nodiscard]] const std::vector<std::string>& columnsAfterParameters();

/// The cells that every run has, whatever became of it.
[[nodiscard]] Columns identityColumns(const RunRecord& record, int threads);

/// The cells that the frames give. `peakResidentBytes` of the process.
[[nodiscard]] Columns measuredColumns(std::span<const FrameRecord> frames, std::int64_t peakResidentBytes);

}  // namespace dustbench::bench
