// Writes one file of a volume format: what the exporters (exporter.h) of the formats call, and tests without them.
//
// Each file is written completely or not at all. Throws InputError if it cannot be written.
// Units: metres, seconds, extinction per metre. Frame: world.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "bench/export/collected_volume.h"
#include "bench/export/extinction_grid.h"
#include "bench/export/vtk_file.h"
#include "methods/contract/volume.h"

namespace dustbench::exports {

// --- VTK image data (.vti)

/// Cell data `extinction` (floats, per metre).
void writeVti(const ExtinctionGrid& grid, const FileOrigin& origin, const std::filesystem::path& file);
/// A method's own grid with all its fields as cell data, unresampled. The unit of field `x` is stored as field data
/// `x_unit`.
void writeGridVti(const CollectedGrid& grid, const FileOrigin& origin, const std::filesystem::path& file);

// --- VTK polygons (.vtp), and pictures of surfaces

/// Particles as points with serial, age, lifetime, radius, opacity, velocity and, if they differ in it, colour and
/// system. `systems`: the number of the system of each particle, from 1; empty: all are of one.
void writeVtp(const Puffs& dust, const FileOrigin& origin, const std::filesystem::path& file,
              std::span<const int> systems = {});

/// A surface that a method changed: points, quadrilaterals and the points' `colour` (linear RGB), `height` and further
/// fields.
void writeSurface(const CollectedSurface& surface, const FileOrigin& origin, const std::filesystem::path& file);
/// The surface's heights as a grey `.exr`, one pixel per point, rows from the top, as for the key `heights` of a
/// relief.
void writeHeights(const CollectedSurface& surface, const std::filesystem::path& file);
/// The four channels of a method's state as RGBA of an `.exr`, as they are, rows from the top in memory's order.
void writeTexture(const CollectedTexture& texture, const std::filesystem::path& file);

// --- VTK hyper-tree grid (.htg)

/// A method's octree as one tree whose nodes are refined to all eight children. Cell data, in leaves and in inner
/// nodes:
///   extinction      per metre. Leaf: the sum over its own voxel and those of all its ancestors. Inner node: the mean
///   of
///                   its children, so that the tree has the same mass at whatever depth it is cut off
///   own_extinction  per metre, of the voxel at this node; 0 if there is none
///   opacity         1 − exp(−extinction·edge)
///   age             seconds; the youngest voxel at, above or (inner nodes) below this node; NaN: none
///   level           the finest voxel at, above or (inner nodes) below this node, as in OctreeVoxel; −1: none
/// Throws std::logic_error if the voxels are not in pre-order.
void writeHtg(const CollectedOctree& octree, const FileOrigin& origin, const std::filesystem::path& file);

// --- OpenVDB (.vdb): voxels are samples at nodes, so the transform puts each at its cell's centre, origin + spacing/2

enum class VdbPrecision { half, single };

/// A fog volume `density`, per metre. Sparse: cells without extinction are not stored. Throws InputError also if half
/// floats cannot represent the maximum value.
void writeVdb(const ExtinctionGrid& grid, VdbPrecision precision, std::int64_t frame, double timeSeconds,
              const std::filesystem::path& file);
/// A method's own grid as one OpenVDB grid per field. Sparse: zeros are not stored. Single precision; the unit is
/// stored as metadata `unit`.
void writeGridVdb(const CollectedGrid& grid, std::int64_t frame, double timeSeconds, const std::filesystem::path& file);

}  // namespace dustbench::exports
