// What files may ask for, in one place: the guide (reports/guide/trust.md) lists it. Readers check a limit before they
// allocate or loop, and a refusal names it.
//
// Units: bytes, pixels, levels, runs.
#pragma once

#include <cstdint>

namespace dustbench::files::limits {

/// TOML, CSV, JSON and templates: 64 MB.
inline constexpr std::uintmax_t textBytes = 64'000'000;
/// Meshes, voxels and volumes: 1 GB.
inline constexpr std::uintmax_t geometryBytes = 1'000'000'000;
/// Results whose SHA-256 is kept: 4 GB.
inline constexpr std::uintmax_t summedBytes = 4'000'000'000;
/// Tables and arrays within each other.
inline constexpr int tomlLevels = 256;

/// Edge of an image, and all of it decoded to floats: 1 GB (2^30 bytes, four channels of 8192 x 8192).
inline constexpr int imageEdge = 16'384;
inline constexpr std::uintmax_t imageBytes = std::uintmax_t{1} << 30;
/// Cells of a volume.
inline constexpr std::int64_t volumeCells = 256'000'000;
/// A volume that is kept sparse: cells of the box around its density, which no file need hold, cells along an edge of
/// it, and bricks of 8 x 8 x 8 cells of one moment, 2 GB of floats.
inline constexpr std::int64_t sparseVolumeCells = 2'000'000'000;
inline constexpr int sparseVolumeEdge = 65'536;
inline constexpr std::int64_t volumeBricks = 1'000'000;
/// Cells of the box around the vectors of a `.vdb`, whose file need not hold them: 1 GB of vectors.
inline constexpr std::int64_t sparseCells = 89'000'000;
/// Particles of one moment of dust from a file, and bytes of all its moments, or a volume's, in memory: 4 GB.
inline constexpr std::int64_t dustParticles = 10'000'000;
inline constexpr std::uintmax_t dustBytes = 4'000'000'000;
/// Moments of dust from files.
inline constexpr std::int64_t dustMoments = 100'000;
/// Samples of a height field along one side.
inline constexpr int heightEdge = 8'192;

/// Corners of one polygon, of which a concave one takes time that grows with their square.
inline constexpr std::int64_t polygonCorners = 4'096;
/// Vertices, faces and other elements of a mesh, each.
inline constexpr std::int64_t meshElements = 100'000'000;

inline constexpr int repetitions = 1'000;
/// Cells times repetitions of a command, before those of the null method.
inline constexpr std::int64_t plannedRuns = 100'000;

}  // namespace dustbench::files::limits
