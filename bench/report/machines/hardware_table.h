// A table of the machines' hardware, software and measurements, with a column for each machine.
#pragma once

#include <string>
#include <vector>

#include "bench/report/machines/machine_set.h"

namespace dustbench::bench {

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

}  // namespace dustbench::bench
