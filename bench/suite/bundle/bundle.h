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

#include "bench/results/run_spec.h"
#include "bench/results/stored_run.h"

namespace dustbench::suite {

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
    results::StoredRuns runs;
};

/// Extracts the archive below the folder and verifies it. Throws InputError with the first file that is damaged,
/// missing, unlisted, or in conflict with the record of a run.
[[nodiscard]] OpenedBundle openBundle(const std::filesystem::path& archive, const std::filesystem::path& below);

/// Runs of one simulation, which differ only in repetition, threads, pictures or metrics, and what every machine
/// reproduces of them bit for bit: the hash of the state after the last frame.
struct ExactRun {
    std::vector<std::string> runIds;    ///< runs that are done
    std::string stateHash, methodHash;  ///< the same for all of them
    results::RunSpec spec;              ///< the minimum to repeat them: no pictures, volumes or metrics
};

/// Groups the runs that are done, in the order of run ids. Throws InputError if two runs of one simulation have
/// different hashes, or if a run has no key.
[[nodiscard]] std::vector<ExactRun> exactRuns(const results::StoredRuns& runs);

/// `state_hash is 1, expected 2; method_hash …`; empty if both are the same.
[[nodiscard]] std::string hashDifference(const results::StoredRun& got, const ExactRun& expected);

}  // namespace dustbench::suite
