// The files that a run left beside its run.json, with their SHA-256: a result of which one was altered or lost since
// does not count as done.
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
    std::string sha256;  ///< empty above files::limits::summedBytes: held to its length alone
};

/// All files below the run's folder, by name, but those that are no results of it: run.json itself, the specification
/// and log.txt, which are written around the run. Throws std::filesystem::filesystem_error.
[[nodiscard]] std::vector<OutputFile> outputsIn(const std::filesystem::path& runFolder);

/// The first output that is not as it was written, as a clause: `frames.csv is missing`; empty if there is none.
/// Lengths are looked at before contents.
[[nodiscard]] std::string whyAltered(std::span<const OutputFile> outputs, const std::filesystem::path& runFolder);

/// Whether the name stays below the folder that it is relative to.
[[nodiscard]] bool isWithin(const std::filesystem::path& name);

}  // namespace dustbench::bench
