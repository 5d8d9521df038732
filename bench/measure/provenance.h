// Provenance of a result: the machine and what disturbs measurements on it, the program, the inputs and the time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/measure/clock.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::measure {

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

/// How this program was built. The commit is empty if it was built outside git.
struct BuildFacts {
    std::string version;
    std::string gitCommit;
    bool gitDirty = false;
    std::string compiler;
    std::string flags;
    std::string buildType;
    std::string buildId;  ///< hexadecimal, unique to each build of the program file; empty if the linker wrote none
};
[[nodiscard]] BuildFacts buildFacts();

struct InputHash {
    std::string file;
    std::string sha256;
};

/// Unused parts of an input file: `array 'material' at cells`.
struct IgnoredParts {
    std::string file;
    std::vector<std::string> parts;
};

/// Where the shared dust was simulated.
struct DustPlace {
    std::string place;  ///< `cpu` or `gpu`; empty if no device was created
    std::string why;    ///< `requested`, `software device` …
};

struct Provenance {
    std::vector<std::string> argv;
    BuildFacts build;
    Machine machine;
    gpu::DeviceInfo device;  ///< empty strings if no device was created
    DustPlace dustOn{};
    bool gpuTimersTrusted = false;
    ClockCost clock;
    std::vector<InputHash> inputs;
    std::vector<InputHash> searches;  ///< searches for files, with the hash of the names found
    std::vector<IgnoredParts> ignored;
    /// Environment variables that affect drawing or threads, `NAME=value`, sorted by name, separated by spaces.
    std::string environment;
    std::string startedUtc;  ///< ISO 8601, to the second
    std::vector<std::string> warnings;
};

/// Selects from `NAME=value` texts the variables of Mesa, LLVM, OpenGL drivers, oneTBB and OpenMP.
[[nodiscard]] std::string drawingEnvironment(const char* const* variables);

/// Facts known at the start of this process. The caller adds device, timers and inputs. `measuresTimes`: adds warnings
/// about disturbances of times.
[[nodiscard]] Provenance startProvenance(std::vector<std::string> argv, bool measuresTimes = true);

/// Hashes input files. Paths inside a data folder are relative to it, so that results from two checkouts compare equal.
[[nodiscard]] std::vector<InputHash> hashInputs(const std::vector<std::filesystem::path>& files);

/// The unused parts of files; paths as above.
[[nodiscard]] std::vector<IgnoredParts> ignoredParts(
    const std::map<std::filesystem::path, std::vector<std::string>>& ofFiles);
/// One line: the ignored parts of a file, and the number of other files with ignored parts; empty if there are none.
[[nodiscard]] std::string saysIgnored(const std::vector<IgnoredParts>& ignored);

/// Hashes the names that these paths match now: a pattern matches files, any other path matches itself if it exists.
[[nodiscard]] std::vector<InputHash> hashSearches(const std::vector<std::filesystem::path>& paths);
/// The same for one path.
[[nodiscard]] std::string hashOfFoundNames(const std::filesystem::path& path);

/// The command line of this process.
[[nodiscard]] std::vector<std::string> commandLine();

}  // namespace dustbench::measure
