// How much room a run's files may take, so that a long list of runs does not end in half a file.
//
// Units: bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "bench/results/run_spec.h"

namespace dustbench::bench {

/// At most, as far as it can be known before: tables, pictures without compression, grids at their full resolution. How
/// many particles and octree nodes a volume will hold is not known; they count as a grid does.
[[nodiscard]] std::uint64_t maximumBytesOf(const RunSpec& spec);

/// What an ordinary user may still write where `folder` lies.
[[nodiscard]] std::uint64_t freeBytes(const std::filesystem::path& folder);

/// `1.4 GB`
[[nodiscard]] std::string bytesText(std::uint64_t bytes);

}  // namespace dustbench::bench
