// Attributes to set on voxels: on all voxels of a shape at first, or by an edit in a box, a sphere or a mesh.
//
// Units: metres, seconds, linear RGB; sizes in voxel edges, so that they fit any resolution. Frame: the shape's own.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "methods/voxel_shape/voxels/solid_space.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

/// Empty attributes stay unchanged.
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
    /// Whether it sets nothing.
    [[nodiscard]] bool isEmpty() const;
    /// Whether it sets attributes of a voxel that it removes: `active = false` together with others.
    [[nodiscard]] bool contradictsItself() const;
};

/// A change of the active voxels (of all voxels if it activates them) whose centres lie in a box, a sphere or a closed
/// mesh.
struct VoxelEdit {
    enum class Region { box, sphere, mesh };

    std::string where;  ///< prefix of messages: `bunny.toml:31: `
    Region region = Region::box;
    glm::vec3 minimum{0}, maximum{0};  ///< of a box
    glm::vec3 centre{0}, end{0};       ///< of a sphere that is swept from `centre` to `end`
    float radiusMetres = 0;
    std::shared_ptr<const SolidSpace> mesh;  ///< in the shape's frame
    VoxelChange change;

    [[nodiscard]] bool contains(const glm::vec3& point) const;
    /// Applies the change. A voxel that it activates starts as a copy of the nearest active one. Throws InputError if
    /// it meets no voxel. Updates the grid's list of active voxels.
    void applyTo(VoxelGrid& grid) const;
};

}  // namespace dustbench::voxel_shape
