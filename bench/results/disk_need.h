// Estimates the disk space of a run's files before it starts, so that long suites do not fail half-way.
//
// Units: bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "bench/results/run_spec.h"

namespace dustbench::bench {

/// Upper bound, as far as known in advance, from tables, uncompressed pictures and grids at full resolution. The
/// numbers of particles and octree nodes in a volume are not known; such a volume counts as a grid.
[[nodiscard]] std::uint64_t maximumBytesOf(const RunSpec& spec);

/// Space available to an ordinary user on the file system of `folder`.
[[nodiscard]] std::uint64_t freeBytes(const std::filesystem::path& folder);

/// `1.4 GB`
[[nodiscard]] std::string bytesText(std::uint64_t bytes);

}  // namespace dustbench::bench
