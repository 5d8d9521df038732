// Groups the runs of a folder into experiments: one per known suite, and one for the rest.
#pragma once

#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::report {

/// The machine of each run by run id, as an index into ReportData::machines.
using MachineOfRun = std::map<std::string, std::size_t, std::less<>>;

/// Contains pointers into `runs`. Unreadable suites are skipped, and reported in `problems` if runs remain without a
/// suite.
[[nodiscard]] std::vector<RunGroup> sortIntoGroups(const results::StoredRuns& runs, const MachineOfRun& machines,
                                                   std::vector<std::string>& problems);

/// Axes, cells and fits of these runs.
[[nodiscard]] RunGroup makeGroup(const std::vector<const results::StoredRun*>& runs, const MachineOfRun& machines);

/// `billboard soft=on`: the method and those of its settings that are axes.
[[nodiscard]] std::string variantLabel(const RunGroup& group, const ReportCell& cell);
/// `speed=20 particles=500`: the world's settings.
[[nodiscard]] std::string worldLabel(const RunGroup& group, const ReportCell& cell);

}  // namespace dustbench::report
