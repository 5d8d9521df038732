// The data of the page that compares several machines, and of its text version.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/report/machines/agreement.h"
#include "bench/report/machines/hardware_table.h"
#include "bench/report/machines/machine_ratios.h"
#include "bench/report/machines/machine_remarks.h"

namespace dustbench::bench {

/// Move, do not copy: contains pointers into its set.
struct MachineComparison {
    MachineSet set;
    MachineCells cells;
    MachineRemarks remarks;
    std::vector<HardwareRow> hardware;
    std::vector<MachineExperiment> experiments;
    std::vector<SharedClaim> claims;

    /// False if no configuration is completed on two machines; the remarks then give the reasons.
    [[nodiscard]] bool isComparable() const { return cells.haveSomethingInCommon(); }
};

[[nodiscard]] MachineComparison comparisonOf(MachineSet set);

/// As JSON, safe inside a script element. The fields are documented at the top of reports/page/machines/page.js.
[[nodiscard]] std::string machinesJson(const MachineComparison& comparison);

/// The whole page, self-contained.
[[nodiscard]] std::string machinesPage(const MachineComparison& comparison);

/// Writes the page to `out`, a file that ends in `.html`, or to index.html in a folder, which is created if missing.
/// Returns its path. Throws InputError if it would replace a page that was not written by this program, or the report
/// of one of the folders.
std::filesystem::path writeMachinesPage(const std::filesystem::path& out, const MachineComparison& comparison);

}  // namespace dustbench::bench
