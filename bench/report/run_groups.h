// Sorts the runs of a folder into experiments: those of each suite that is known, and all others.
#pragma once

#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// Which machine each run was measured on, by run id, as an index into ReportData::machines.
using MachineOfRun = std::map<std::string, std::size_t, std::less<>>;

/// Points into `runs`. Suites that cannot be read are left out, with a sentence in `problems` where runs are left over.
[[nodiscard]] std::vector<RunGroup> sortIntoGroups(const StoredRuns& runs, const MachineOfRun& machines,
                                                   std::vector<std::string>& problems);

/// Axes, cells and fits of these runs.
[[nodiscard]] RunGroup makeGroup(const std::vector<const StoredRun*>& runs, const MachineOfRun& machines);

/// Columns of summary.csv that are numbers, as charts can show them, in its order.
[[nodiscard]] const std::vector<std::string>& numericColumns();

/// `billboard soft=on`: the method and its settings that are axes, world's left out.
[[nodiscard]] std::string variantLabel(const RunGroup& group, const ReportCell& cell);
/// `speed=20 particles=500`: the world's.
[[nodiscard]] std::string worldLabel(const RunGroup& group, const ReportCell& cell);

}  // namespace dustbench::bench
