// Writes a method's octree as a VTK hyper-tree grid: one tree whose nodes are refined to all eight children.
//
// Cell data, in leaves and in inner nodes:
//   extinction per metre. Leaf: the sum over its own voxel and all its ancestors'. Inner node: the mean of its
//   children, so
//                   that every depth to which the tree is cut off has the same mass
//   own_extinction  per metre, of the very voxel at the node; 0 where there is none
//   opacity         1 − exp(−extinction·edge)
//   age             seconds; of the youngest voxel over a leaf, or over and within an inner node; NaN: there is none
//   level           of the finest voxel over a leaf, or over and within an inner node, as in OctreeVoxel; −1: none
#pragma once

#include <filesystem>

#include "bench/export/collected_volume.h"

namespace dustbench::bench {

/// Whole or not at all. Throws InputError where it cannot be written, std::logic_error where the voxels are not in
/// pre-order.
void writeHtg(const CollectedOctree& octree, double timeSeconds, const std::filesystem::path& file);

}  // namespace dustbench::bench
