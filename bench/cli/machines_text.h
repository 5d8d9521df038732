// A comparison of several machines, as text for a terminal.
#pragma once

#include <string>

#include "bench/report/machines/machine_comparison.h"

namespace dustbench::cli {

[[nodiscard]] std::string machinesText(const bench::MachineComparison& comparison);

}  // namespace dustbench::cli
