// Everything that the page of several machines shows, and its text in a terminal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/report/machines/agreement.h"
#include "bench/report/machines/hardware_table.h"
#include "bench/report/machines/machine_ratios.h"
#include "bench/report/machines/machine_remarks.h"

namespace dustbench::bench {

/// Move, do not copy: points into its set.
struct MachineComparison {
    MachineSet set;
    MachineCells cells;
    MachineRemarks remarks;
    std::vector<HardwareRow> hardware;
    std::vector<MachineExperiment> experiments;
    std::vector<SharedClaim> claims;

    /// False if no cell is done on two machines; then the remarks say why.
    [[nodiscard]] bool isComparable() const { return cells.haveSomethingInCommon(); }
};

[[nodiscard]] MachineComparison comparisonOf(MachineSet set);

/// As JSON, safe inside a script element. The fields are documented at the top of reports/report/machines/page.js.
[[nodiscard]] std::string machinesJson(const MachineComparison& comparison);

/// The whole page, self-contained.
[[nodiscard]] std::string machinesPage(const MachineComparison& comparison);

/// Writes the page to `out`, a file that ends in `.html`, or index.html in a folder, which is made; returns its path.
/// Throws InputError for a page that was not written by this program, or the report of one of the folders.
std::filesystem::path writeMachinesPage(const std::filesystem::path& out, const MachineComparison& comparison);

}  // namespace dustbench::bench
