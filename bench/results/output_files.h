// The output files of a run: the disk space that they need, estimated before it starts so that long suites do not fail
// half-way, and their SHA-256 afterwards. A result with an altered or missing output file does not count as done.
//
// Units: bytes. Threads: any.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/results/run_spec.h"

namespace dustbench::results {

struct OutputFile {
    std::string file;  ///< relative to the run's folder
    std::uintmax_t bytes = 0;
    std::string sha256;  ///< empty above files::limits::summedBytes: only the length is checked
};

/// All files below the run's folder, by name, except run.json, the specification and log.txt, which are not results.
/// Throws std::filesystem::filesystem_error.
[[nodiscard]] std::vector<OutputFile> outputsIn(const std::filesystem::path& runFolder);

/// The first output that was altered or is missing, as a clause: `frames.csv is missing`; empty if there is none.
/// Checks lengths before contents.
[[nodiscard]] std::string whyAltered(std::span<const OutputFile> outputs, const std::filesystem::path& runFolder);

/// Whether the relative name stays within its folder.
[[nodiscard]] bool isWithin(const std::filesystem::path& name);

/// Upper bound, as far as known in advance, from tables, uncompressed pictures and grids at full resolution. The
/// numbers of particles and octree nodes in a volume are not known; such a volume counts as a grid.
[[nodiscard]] std::uint64_t maximumBytesOf(const RunSpec& spec);

/// Space available to an ordinary user on the file system of `folder`.
[[nodiscard]] std::uint64_t freeBytes(const std::filesystem::path& folder);

/// `1.4 GB`
[[nodiscard]] std::string bytesText(std::uint64_t bytes);

}  // namespace dustbench::results
