// Writes a method's octree as a VTK hyper-tree grid: one tree whose nodes are refined to all eight children.
//
// Cell data, in leaves and in inner nodes:
//   extinction      per metre. Leaf: the sum over its own voxel and those of all its ancestors. Inner node: the mean of
//                   its children, so that the tree has the same mass at whatever depth it is cut off
//   own_extinction  per metre, of the voxel at this node; 0 if there is none
//   opacity         1 − exp(−extinction·edge)
//   age             seconds; the youngest voxel at, above or (inner nodes) below this node; NaN: none
//   level           the finest voxel at, above or (inner nodes) below this node, as in OctreeVoxel; −1: none
#pragma once

#include <filesystem>

#include "bench/export/collected_volume.h"
#include "bench/export/vtk_file.h"

namespace dustbench::bench {

/// Writes the whole file or none. Throws InputError if it cannot be written, std::logic_error if the voxels are not in
/// pre-order.
void writeHtg(const CollectedOctree& octree, const FileOrigin& origin, const std::filesystem::path& file);

}  // namespace dustbench::bench
