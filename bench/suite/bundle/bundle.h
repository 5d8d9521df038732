// A bundle: an archive of a results folder and everything that its runs depend on, for others to verify and repeat.
//
//     <name>/results/…      the unchanged results folder
//     <name>/inputs/…       data files that its runs read, laid out like a data folder
//     <name>/outside/…      other files that they read: `<first 12 digits of the SHA-256>-<file name>`
//     <name>/suites/…       the suites that planned the runs
//     <name>/bundle.json    an index of the files (reports/SCHEMA.md)
//     <name>/SHA256SUMS     checksums of all of the above, for `sha256sum --check`
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
    std::uintmax_t bytes = 0;            ///< total size of the files
    std::vector<std::string> missing{};  ///< suites that could not be packed, one sentence each
};

/// Writes the archive of a results folder, completely or not at all. Throws InputError if it is not a results folder,
/// a result was altered, or an input has changed since the runs read it.
PackedBundle packBundle(const std::filesystem::path& results, const std::filesystem::path& archive);

/// An extracted bundle with verified checksums.
struct OpenedBundle {
    std::filesystem::path folder;  ///< <name>/
    std::size_t files = 0;
    StoredRuns runs;
};

/// Extracts the archive below the folder and verifies it. Throws InputError with the first file that is damaged,
/// missing, unlisted, or in conflict with the record of a run.
[[nodiscard]] OpenedBundle openBundle(const std::filesystem::path& archive, const std::filesystem::path& below);

}  // namespace dustbench::bench
