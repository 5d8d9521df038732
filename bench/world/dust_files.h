// Reads the moments of dust that a path names: one file of particles, a series (`.pvd`, `.series`), a table with a
// column of times, or a volume.
//
// A volume is converted to particles, so that it can be compared with methods that draw puffs: one puff for each cell
// with density, with all of the cell's mass.
//
//     τ·2π·s² = σ·h³,   s = 0.7·h        h: edge of the cell, σ: its extinction
//
// At this width, puffs add up to uniform density within 2e-4 where the density is uniform; the picture differs from
// that of the volume by O(h²). The cell's index is the particle's id: between two moments its depth changes linearly,
// like the cell's density. Each moment therefore also contains the cells that are filled in the previous or next
// moment, with an opacity of 0.
//
// Units: m, s. Frame: world.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/world/dust_moment.h"
#include "methods/kit/volumes/volume_series.h"

namespace dustbench::world {

struct DustFiles {
    std::vector<DustMoment> moments;           ///< in the order of the series
    std::vector<std::filesystem::path> files;  ///< all files read, the series first
    std::optional<glm::vec3> albedo{};         ///< from a volume; empty: the scene's
};

/// `.vtp`, `.vdb`, `.csv`, `.pvd`, `.series`; or several of the first three by a `*` in the file's name; or a volume,
/// from which particles are made (dustOfVolume) and which has no columns. Throws InputError, one line with the file.
[[nodiscard]] DustFiles readDustFiles(const std::filesystem::path& path, const DustColumns& columns, bool hasColumns);

/// Memory of the moments. Throws InputError if it exceeds files::limits::dustBytes.
void requireDustFits(double particles, const std::filesystem::path& path);

/// s of a puff in units of the edge of its cell or block of cells.
inline constexpr double puffDeviationCells = 0.7;

/// The moments of a volume as particles. Blocks of `setup.blockCells`³ cells count as one cell. Throws InputError, one
/// line with the file, if a moment has more particles than allowed for dust, or a cell more depth than allowed for a
/// puff.
[[nodiscard]] std::vector<DustMoment> dustOfVolume(const volumes::VolumeSeries& series,
                                                   const volumes::VolumeSetup& setup);

}  // namespace dustbench::world
