// Remarks for a comparison of machines: what cannot be compared, and why.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/report/machines/machine_set.h"

namespace dustbench::report {

/// A configuration that was measured on some machines but not on others.
struct MissingCell {
    std::string cell;             ///< `billboard particles=500`
    std::vector<std::size_t> on;  ///< machines on which it is completed
    /// The other machines, with the reason: `not measured`, `invalid: …`, `copied …`, `failed: …`, `skipped: …`.
    std::vector<std::pair<std::size_t, std::string>> lacking;
};

/// Each sentence is one line.
struct MachineRemarks {
    /// Settings, methods, suites or inputs without a counterpart on other machines.
    std::vector<std::string> apart;
    /// Differences between the programs, which may be the cause of different results.
    std::vector<std::string> programs;
    /// Identical machines or different kinds, numbers of threads, damaged and unknown runs.
    std::vector<std::string> notes;
    /// Missing configurations that `apart` does not explain.
    std::vector<MissingCell> missing;
};

[[nodiscard]] MachineRemarks remarksOn(const MachineSet& set, const MachineCells& cells);

}  // namespace dustbench::report
