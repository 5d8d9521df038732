// Limits on the content of files, in one place; reports/guide/trust.md lists them. Readers check a limit before they
// allocate or loop, and an error message names it.
//
// Units: bytes, pixels, levels, runs.
#pragma once

#include <cstdint>

namespace dustbench::files::limits {

/// TOML, CSV, JSON and templates: 64 MB.
inline constexpr std::uintmax_t textBytes = 64'000'000;
/// Meshes, voxels and volumes: 1 GB.
inline constexpr std::uintmax_t geometryBytes = 1'000'000'000;
/// Results that get a SHA-256 sum: 4 GB.
inline constexpr std::uintmax_t summedBytes = 4'000'000'000;
/// Nesting depth of tables and arrays.
inline constexpr int tomlLevels = 256;

/// Edge of an image. Decoded to floats, an image has at most 1 GB (2^30 bytes, four channels of 8192 x 8192).
inline constexpr int imageEdge = 16'384;
inline constexpr std::uintmax_t imageBytes = std::uintmax_t{1} << 30;
/// Cells of a volume.
inline constexpr std::int64_t volumeCells = 256'000'000;
/// A volume stored sparsely: cells of the box around its density, which the file need not store, cells along an edge
/// of the box, and bricks of 8 x 8 x 8 cells at one time, 2 GB of floats.
inline constexpr std::int64_t sparseVolumeCells = 2'000'000'000;
inline constexpr int sparseVolumeEdge = 65'536;
inline constexpr std::int64_t volumeBricks = 1'000'000;
/// Cells of the box around the vectors of a `.vdb`, whose file need not store them: 1 GB of vectors.
inline constexpr std::int64_t sparseCells = 89'000'000;
/// Particles of dust from a file at one time, and the bytes in memory of a whole series of dust or volumes: 4 GB.
inline constexpr std::int64_t dustParticles = 10'000'000;
inline constexpr std::uintmax_t dustBytes = 4'000'000'000;
/// Times in a series of dust files.
inline constexpr std::int64_t dustMoments = 100'000;
/// Samples of a height field along one side.
inline constexpr int heightEdge = 8'192;

/// Corners of one polygon. The time for a concave one grows with the square of this number.
inline constexpr std::int64_t polygonCorners = 4'096;
/// Vertices, faces and other elements of a mesh, each kind separately.
inline constexpr std::int64_t meshElements = 100'000'000;

inline constexpr int repetitions = 1'000;
/// Runs of a command, that is configurations times repetitions, without those of the null method.
inline constexpr std::int64_t plannedRuns = 100'000;

}  // namespace dustbench::files::limits
