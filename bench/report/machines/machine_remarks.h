// What must be known before machines are compared: what cannot be, and why.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/report/machines/machine_cells.h"

namespace dustbench::bench {

/// A cell that some machines have and others lack.
struct MissingCell {
    std::string cell;             ///< `billboard particles=500`
    std::vector<std::size_t> on;  ///< machines on which it is done
    /// The others, with the reason: `not measured`, `invalid: …`, `copied …`, `failed: …`, `skipped: …`.
    std::vector<std::pair<std::size_t, std::string>> lacking;
};

/// Each sentence is one line.
struct MachineRemarks {
    /// Other settings, methods, suites or inputs: their cells have no counterpart.
    std::vector<std::string> apart;
    /// Other programs: what differs may be their doing, not the machines'.
    std::vector<std::string> programs;
    /// Machines that are alike, or of another kind; numbers of threads; damaged and unknown runs.
    std::vector<std::string> notes;
    /// Cells that are missing for no reason given in `apart`.
    std::vector<MissingCell> missing;
};

[[nodiscard]] MachineRemarks remarksOn(const MachineSet& set, const MachineCells& cells);

}  // namespace dustbench::bench
