// Where a result comes from: the program, the machine, the inputs and the hour.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bench/measure/clock.h"
#include "bench/measure/machine.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::bench {

/// How this program was built. The commit is empty where it was built outside git.
struct BuildFacts {
    std::string version;
    std::string gitCommit;
    bool gitDirty = false;
    std::string compiler;
    std::string flags;
    std::string buildType;
    std::string buildId;  ///< of the program file, hexadecimal: another build, another id; empty: the linker gave none
};
[[nodiscard]] BuildFacts buildFacts();

struct InputHash {
    std::string file;
    std::string sha256;
};

struct Provenance {
    std::vector<std::string> argv;
    BuildFacts build;
    Machine machine;
    gpu::DeviceInfo device;  ///< empty texts where no device was made
    bool gpuTimersTrusted = false;
    ClockCost clock;
    std::vector<InputHash> inputs;
    std::string startedUtc;  ///< ISO 8601, to the second
    std::vector<std::string> warnings;
};

/// Now, for this process; device, timers and inputs are added by whoever knows them.
[[nodiscard]] Provenance startProvenance(std::vector<std::string> argv);

/// Paths inside the data folder are named relative to it, so that results of two checkouts compare equal.
[[nodiscard]] std::vector<InputHash> hashInputs(const std::vector<std::filesystem::path>& files);

/// The command line of this process.
[[nodiscard]] std::vector<std::string> commandLine();

}  // namespace dustbench::bench
