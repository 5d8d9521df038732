// The output files of a run with their SHA-256. A result with an altered or missing output file does not count as done.
//
// Threads: any.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace dustbench::bench {

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

}  // namespace dustbench::bench
