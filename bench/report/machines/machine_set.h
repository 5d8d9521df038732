// Results folders of several machines, to be compared: the runs of each machine, its hardware, and the configurations
// that the machines measured.
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
#include "bench/suite/regression/folder_cells.h"

namespace dustbench::report {

/// The runs of one machine in one folder: a column of the tables, a line in the charts.
struct MachineSide {
    std::string label;       ///< that of the folder, with a number if the folder has several machines
    std::size_t folder = 0;  ///< index in MachineSet::folders
    std::vector<const results::StoredRun*> runs;  ///< sorted by id; including runs that did not complete
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

/// A row of the table of hardware, software and measurements, which has a column for each machine.
struct HardwareRow {
    std::string name;                 ///< `CPU`, `governor`, `warnings`
    std::vector<std::string> values;  ///< by MachineSet::sides; empty if unknown
    [[nodiscard]] bool differs() const;
};

[[nodiscard]] std::vector<HardwareRow> hardwareTable(const MachineSet& set);

/// True if a software renderer drew every run.
[[nodiscard]] bool isSoftware(const MachineSide& side);

/// True if CPU, cores, memory and graphics are the same: one machine, or two identical ones.
[[nodiscard]] bool areAlike(const MachineSide& a, const MachineSide& b);

/// A configuration measured on several machines: all of its runs, whose settings differ only in the repetition.
struct MachineCell {
    suite::CellIdentity identity;
    std::vector<suite::CellRuns> sides;  ///< by MachineSet::sides
    /// An input that is not the same everywhere, or `state_hash`: different work was measured, and its times are not
    /// shown. Empty if the work is the same.
    std::string otherWork{};

    [[nodiscard]] bool isDoneOn(std::size_t side) const { return !sides[side].done.empty(); }
    [[nodiscard]] std::size_t sidesDone() const;
};

struct MachineCells {
    std::vector<MachineCell> cells;     ///< sorted by identity, numbers numerically
    std::vector<std::string> names;     ///< the fields that distinguish cells of a method
    std::vector<std::string> unplaced;  ///< a sentence for each machine with copied runs or with runs without settings
    [[nodiscard]] std::string labelOf(const MachineCell& cell) const { return suite::labelOf(cell.identity, names); }
    /// True if a cell is completed on two machines with the same work.
    [[nodiscard]] bool haveSomethingInCommon() const;
};

/// Points into the set.
[[nodiscard]] MachineCells cellsOf(const MachineSet& set);

}  // namespace dustbench::report
