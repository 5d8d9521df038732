// Reads results folders of several machines for a page that compares them.
//
// The runs of a folder are split by machine (machineFields of compared_runs.h). Usually there is only one.
// Threads: plain data.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// The runs of one machine in one folder: a column of the tables, a line in the charts.
struct MachineSide {
    std::string label;                   ///< that of the folder, with a number if the folder has several machines
    std::size_t folder = 0;              ///< index in MachineSet::folders
    std::vector<const StoredRun*> runs;  ///< sorted by id; including runs that did not complete
    /// The values of a provenance field over the completed runs: two kernels if it was updated in between.
    std::map<std::string, std::set<std::string>, std::less<>> facts;
};

/// Move, do not copy: `sides` contains pointers into the folders.
struct MachineSet {
    MachineSet() = default;
    MachineSet(const MachineSet&) = delete;
    MachineSet& operator=(const MachineSet&) = delete;
    MachineSet(MachineSet&&) = default;
    MachineSet& operator=(MachineSet&&) = default;
    ~MachineSet() = default;

    std::vector<ReportData> folders;
    std::vector<std::string> labels;  ///< of the folders; unique
    std::vector<MachineSide> sides;   ///< in the order of the folders
};

/// The values of the field, `a, b`; empty if no run has it.
[[nodiscard]] std::string factOf(const MachineSide& side, std::string_view field);

/// Distinct names of the folders: the last part of each path, or as many parts as necessary.
[[nodiscard]] std::vector<std::string> folderLabels(const std::vector<std::filesystem::path>& folders);

/// Damaged runs are left out and listed in ReportData::problems. `labels`: one for each folder, or none for
/// folderLabels. Throws InputError for fewer than two folders, for a folder given twice, for equal or empty labels or
/// another number of them, and for a folder without a completed run.
[[nodiscard]] MachineSet readMachines(const std::vector<std::filesystem::path>& folders,
                                      const std::vector<std::string>& labels);

/// The same for folders that were already read.
[[nodiscard]] MachineSet machineSet(std::vector<ReportData> folders, std::vector<std::string> labels);

}  // namespace dustbench::bench
