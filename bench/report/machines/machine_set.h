// Reads result folders of several machines, for a page that shows them side by side.
//
// A folder's runs are split by what they were measured on (machineFields of measured_on.h): usually one machine.
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
    std::string label;                   ///< that of the folder; with a number if the folder holds several machines
    std::size_t folder = 0;              ///< of MachineSet::folders
    std::vector<const StoredRun*> runs;  ///< sorted by id; with those that are not done
    /// The values of a field of provenance over the runs that are done: two kernels if it was updated in between.
    std::map<std::string, std::set<std::string>, std::less<>> facts;
};

/// Move, do not copy: sides point into the folders.
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

/// What tells the folders apart: the last part of each path, or as many parts as it takes.
[[nodiscard]] std::vector<std::string> folderLabels(const std::vector<std::filesystem::path>& folders);

/// Damaged runs are left out and named in ReportData::problems. `labels`: one for each folder, or none: folderLabels.
/// Throws InputError for fewer than two folders, one folder given twice, labels that are equal, empty or not one for
/// each folder, and with the folder if it has no run that is done.
[[nodiscard]] MachineSet readMachines(const std::vector<std::filesystem::path>& folders,
                                      const std::vector<std::string>& labels);

/// The same of folders that were read.
[[nodiscard]] MachineSet machineSet(std::vector<ReportData> folders, std::vector<std::string> labels);

}  // namespace dustbench::bench
