// A bundle: a folder of results with all that they depend on, as one archive that others can check and repeat.
//
//     <name>/results/…      the folder, as it is
//     <name>/inputs/…       files of data that its runs read, laid out as a folder of data
//     <name>/outside/…      files that they read elsewhere: `<first 12 digits of the SHA-256>-<file name>`
//     <name>/suites/…       the suites that measured them
//     <name>/bundle.json    which file is which (reports/SCHEMA.md)
//     <name>/SHA256SUMS     of all of the above, as `sha256sum --check` reads it
//
// Threads: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

struct PackedBundle {
    std::size_t files = 0;
    std::uintmax_t bytes = 0;            ///< of the files
    std::vector<std::string> missing{};  ///< what it lacks of suites, each a sentence
};

/// Writes the archive of the results folder, whole or not at all. Throws InputError if it is no folder of results, a
/// result was altered, or an input is not as the runs have read it.
PackedBundle packBundle(const std::filesystem::path& results, const std::filesystem::path& archive);

/// A bundle whose files are all as they were packed.
struct OpenedBundle {
    std::filesystem::path folder;  ///< <name>/
    std::size_t files = 0;
    StoredRuns runs;
};

/// Extracts the archive below the folder and checks it. Throws InputError with what is damaged, missing, too much, or
/// not what a run says of itself.
[[nodiscard]] OpenedBundle openBundle(const std::filesystem::path& archive, const std::filesystem::path& below);

}  // namespace dustbench::bench
