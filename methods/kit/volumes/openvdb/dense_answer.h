// Writes the position of an OpenVDB grid and its values in a box, cell by cell.
#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "methods/kit/volumes/openvdb/answer.h"

namespace dustbench::volumes {

/// The corners may be any 32-bit numbers, whose differences can overflow.
[[nodiscard]] inline double countOf(const openvdb::CoordBBox& box) {
    double cells = 1;
    for (int axis = 0; axis < 3; ++axis)
        cells *= static_cast<double>(box.max()[axis]) - static_cast<double>(box.min()[axis]) + 1;
    return cells;
}

/// The metadata `time_s`, which may be a float or a double.
[[nodiscard]] inline std::optional<double> timeOf(const openvdb::GridBase& grid) {
    if (const auto time = grid.getMetadata<openvdb::DoubleMetadata>("time_s")) return time->value();
    if (const auto time = grid.getMetadata<openvdb::FloatMetadata>("time_s")) return static_cast<double>(time->value());
    return std::nullopt;
}

/// Position and time of the cells in the box.
[[nodiscard]] inline VdbMessage messageOf(const openvdb::GridBase& grid, const openvdb::CoordBBox& box) {
    VdbMessage message;
    message.spacing = grid.voxelSize()[0];
    const openvdb::Vec3d first = grid.indexToWorld(box.min());  // the centre of the first cell
    for (int axis = 0; axis < 3; ++axis) {
        message.cells[axis] = box.max()[axis] - box.min()[axis] + 1;
        message.origin[axis] = first[axis] - message.spacing / 2;
    }
    if (const std::optional<double> time = timeOf(grid)) {
        message.hasTime = 1;
        message.timeSeconds = *time;
    }
    return message;
}

/// Writes a slab of eight layers at a time.
template <typename Value, typename Grid>
void putDense(const Grid& grid, const openvdb::CoordBBox& box) {
    for (int z = box.min().z(); z <= box.max().z(); z += 8) {
        const int last = std::min(z + 7, box.max().z());
        openvdb::tools::Dense<Value, openvdb::tools::LayoutXYZ> slab(
            openvdb::CoordBBox(box.min().x(), box.min().y(), z, box.max().x(), box.max().y(), last));
        openvdb::tools::copyToDense(grid, slab);
        put(slab.data(), slab.valueCount() * sizeof(Value));
    }
}

/// Inactive voxels count as background, whatever their values.
template <typename Grid>
void forgetInactive(Grid& grid) {
    const auto background = grid.background();
    for (auto value = grid.beginValueOff(); value; ++value) value.setValue(background);
}

/// Writes vectors at the centres of cells. Those of class `staggered` are stored on the lower faces and averaged: half
/// of both faces, or only the lower one if there is no upper one.
inline void putVectors(const openvdb::Vec3SGrid& grid, const openvdb::CoordBBox& box) {
    if (grid.getGridClass() != openvdb::GRID_STAGGERED) return putDense<openvdb::Vec3s>(grid, box);
    const auto faces = grid.getConstAccessor();
    std::vector<openvdb::Vec3s> row(static_cast<std::size_t>(box.dim().x()));
    const openvdb::Coord dim = box.dim();
    for (int z = 0; z < dim.z(); ++z)
        for (int y = 0; y < dim.y(); ++y) {
            for (int x = 0; x < dim.x(); ++x) {
                const openvdb::Coord cell = box.min() + openvdb::Coord(x, y, z);
                openvdb::Vec3s& middle = row[static_cast<std::size_t>(x)];
                middle = faces.getValue(cell);
                for (int axis = 0; axis < 3; ++axis) {
                    openvdb::Coord upper = cell;
                    if (upper[axis] == std::numeric_limits<int>::max()) continue;
                    upper[axis] += 1;
                    openvdb::Vec3s above;
                    if (faces.probeValue(upper, above)) middle[axis] = (middle[axis] + above[axis]) / 2;
                }
            }
            put(row.data(), row.size() * sizeof row[0]);
        }
}

}  // namespace dustbench::volumes
