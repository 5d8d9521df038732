// Provenance of a result: the program, the machine, the inputs and the time.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/measure/clock.h"
#include "bench/measure/machine.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::bench {

/// How this program was built. The commit is empty if it was built outside git.
struct BuildFacts {
    std::string version;
    std::string gitCommit;
    bool gitDirty = false;
    std::string compiler;
    std::string flags;
    std::string buildType;
    std::string buildId;  ///< of the program file, hexadecimal, unique to each build; empty if the linker wrote none
};
[[nodiscard]] BuildFacts buildFacts();

struct InputHash {
    std::string file;
    std::string sha256;
};

/// What of an input file nothing uses: `array 'material' at cells`.
struct IgnoredParts {
    std::string file;
    std::vector<std::string> parts;
};

struct Provenance {
    std::vector<std::string> argv;
    BuildFacts build;
    Machine machine;
    gpu::DeviceInfo device;  ///< empty strings if no device was created
    bool gpuTimersTrusted = false;
    ClockCost clock;
    std::vector<InputHash> inputs;
    std::vector<InputHash> searches;  ///< what was looked for, with the hash of the names that were found
    std::vector<IgnoredParts> ignored;
    /// Variables of the environment that change drawing or threads, `NAME=value` in order of their names, by blanks.
    std::string environment;
    std::string startedUtc;  ///< ISO 8601, to the second
    std::vector<std::string> warnings;
};

/// Of these variables, `NAME=value`, those of Mesa, LLVM, OpenGL's drivers, oneTBB and OpenMP.
[[nodiscard]] std::string drawingEnvironment(const char* const* variables);

/// Facts known at the start of this process. The caller adds device, timers and inputs. `measuresTimes`: warns of what
/// disturbs them.
[[nodiscard]] Provenance startProvenance(std::vector<std::string> argv, bool measuresTimes = true);

/// Paths inside the data folder are stored relative to it, so that results from two checkouts compare equal.
[[nodiscard]] std::vector<InputHash> hashInputs(const std::vector<std::filesystem::path>& files);

/// Named likewise.
[[nodiscard]] std::vector<IgnoredParts> ignoredParts(
    const std::map<std::filesystem::path, std::vector<std::string>>& ofFiles);
/// As one line: the parts of a file, and how many other files lack the same; empty if nothing is ignored.
[[nodiscard]] std::string saysIgnored(const std::vector<IgnoredParts>& ignored);

/// What these paths stand for now: a pattern for its files, another path for itself if it is there.
[[nodiscard]] std::vector<InputHash> hashSearches(const std::vector<std::filesystem::path>& paths);
/// Of one of them.
[[nodiscard]] std::string hashOfFoundNames(const std::filesystem::path& path);

/// The command line of this process.
[[nodiscard]] std::vector<std::string> commandLine();

}  // namespace dustbench::bench
