// Describes this machine and possible disturbances of measurements on it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dustbench::bench {

/// Empty strings and zeros: unknown.
struct Machine {
    std::string cpu;
    std::string governor;  ///< cpufreq governor of the first core: `performance`, `powersave` …
    int cores = 0;         ///< available to this process
    std::int64_t ramBytes = 0;
    std::string kernel;
    double loadAverage = 0;  ///< over the last minute
    bool virtualMachine = false;
    double stolenShare = 0;      ///< share of the CPU time since boot that the host gave to other virtual machines
    double quotaCores = 0;       ///< CPU limit of a container, in cores; 0: no limit
    std::int64_t throttled = 0;  ///< number of thermal throttling events of the first core since boot
};

[[nodiscard]] Machine readMachine();

/// One sentence for each cause of unreliable timings on this machine, with a remedy in brackets.
[[nodiscard]] std::vector<std::string> disturbances(const Machine& machine);

}  // namespace dustbench::bench
