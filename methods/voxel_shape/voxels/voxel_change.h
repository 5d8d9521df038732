// Attributes to set on voxels: all at once where a shape's are first given, or some by an edit of a box, a sphere or a
// mesh.
//
// Units: metres, seconds, linear RGB; sizes in edges of a voxel, so that they fit any resolution. Frame: the shape's
// own.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "methods/voxel_shape/voxels/solid_space.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

/// What is empty is left as it is.
struct VoxelChange {
    struct ForceEffect {
        Force kind;
        glm::vec3 vector;
        float number;
    };
    std::optional<bool> active;
    std::optional<glm::vec3> colour, fadingColour;
    std::optional<float> opacity, fadingOpacity;
    std::optional<float> sizeVoxels, fadingSizeVoxels;
    std::optional<float> lifetimeSeconds, interpolationSeconds, picturesPerSecond;
    std::optional<std::uint32_t> maximumDensity;
    std::optional<ForceEffect> force;

    void applyTo(Voxel& voxel, float voxelMetres) const;
    /// Says nothing at all.
    [[nodiscard]] bool isEmpty() const;
    /// Gives a voxel that is no part of the shape anything besides: `active = false` and more.
    [[nodiscard]] bool contradictsItself() const;
};

/// A change of the active voxels (of all, where it makes them active) whose middle lies in a box, a sphere or a closed
/// mesh.
struct VoxelEdit {
    enum class Region { box, sphere, mesh };

    std::string where;  ///< for messages: `bunny.toml:31: `
    Region region = Region::box;
    glm::vec3 minimum{0}, maximum{0};  ///< of a box
    glm::vec3 centre{0};               ///< of a sphere
    float radiusMetres = 0;
    std::shared_ptr<const SolidSpace> mesh;  ///< in the shape's frame
    VoxelChange change;

    [[nodiscard]] bool contains(const glm::vec3& point) const;
    /// A voxel that it puts into the shape starts as a copy of the nearest one there. Throws InputError where it meets
    /// no voxel. The grid's active voxels are listed anew.
    void applyTo(VoxelGrid& grid) const;
};

}  // namespace dustbench::voxel_shape
