// What this machine is, and what about it disturbs a measurement.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dustbench::bench {

/// Empty texts and zeros: the machine does not tell.
struct Machine {
    std::string cpu;
    std::string governor;  ///< of the first core's frequency: `performance`, `powersave` …
    int cores = 0;         ///< that this process may use
    std::int64_t ramBytes = 0;
    std::string kernel;
    double loadAverage = 0;  ///< over the last minute: runnable threads
    bool virtualMachine = false;
    double stolenShare = 0;      ///< of the CPU time since boot: a virtual machine's host gave it to others
    double quotaCores = 0;       ///< CPU time that a container may use, in cores; 0: no limit
    std::int64_t throttled = 0;  ///< how often the first core was slowed down for its heat since boot
};

[[nodiscard]] Machine readMachine();

/// One sentence each: what makes times measured here and now less trustworthy, and in brackets what helps.
[[nodiscard]] std::vector<std::string> disturbances(const Machine& machine);

}  // namespace dustbench::bench
