// What each machine is, and how it was measured: a table with a column for each.
#pragma once

#include <string>
#include <vector>

#include "bench/report/machines/machine_set.h"

namespace dustbench::bench {

struct HardwareRow {
    std::string name;                 ///< `CPU`, `governor`, `warnings`
    std::vector<std::string> values;  ///< by MachineSet::sides; empty: not known
    [[nodiscard]] bool differs() const;
};

[[nodiscard]] std::vector<HardwareRow> hardwareTable(const MachineSet& set);

/// True if every run was drawn by a software renderer.
[[nodiscard]] bool isSoftware(const MachineSide& side);

/// True if CPU, cores, memory and graphics are the same: one machine, or two that are alike.
[[nodiscard]] bool areAlike(const MachineSide& a, const MachineSide& b);

}  // namespace dustbench::bench
