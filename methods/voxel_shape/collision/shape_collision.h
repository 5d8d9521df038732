// Keeps a shape's particles out of the scene's solids, in three steps: the shape's bounding box; then its voxels, which
// are switched off while they touch a solid; then the path of each particle near a solid against the solid's triangles.
//
// A particle that hits a triangle stops one millimetre in front of it. The normal component of its velocity is reversed
// and scaled by `restitution`; the tangential component is scaled by 1 − `friction`. In addition it gets up to
// `scatter` times the normal speed in its own random tangential direction, so that a shape bursts.
//
// Units: m, s. Frame: world. Owns: the solids' tree and grids. Threads: one caller at a time; uses the current oneTBB
// arena; the result does not depend on the number of threads.
// Source: JuckelBeckhaus2007, 5.2. Departs: the paper gives no response.
#pragma once

#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/meshes/triangle_tree.h"
#include "methods/voxel_shape/collision/nearness.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/particles/shape_particles.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

struct Impact {
    float restitution = 0.3f;
    float friction = 0.1f;
    float scatter = 0;  ///< restitution² + scatter² ≤ 1, otherwise particles would gain energy
};

class ShapeCollision {
 public:
    /// `voxelMetres`: the largest edge that the shape's voxels will have in the world.
    ShapeCollision(const scene::Scene& scene, float voxelMetres, const Impact& impact);

    /// The first two steps: switches off the voxels that touch a solid, and switches on the others.
    void switchVoxels(VoxelGrid& grid, const Pose& pose);
    /// The third step, right after the particles moved by `stepSeconds` of their velocity. Returns the number of hits.
    std::size_t stopParticles(ShapeParticles& particles, float stepSeconds) const;

    /// Returns the number of voxels that are switched off now.
    [[nodiscard]] std::size_t switchedOff() const { return off_; }
    [[nodiscard]] MemoryReport memory() const;

 private:
    struct Box {
        glm::vec3 minimum, maximum;
        [[nodiscard]] bool meets(const Box& other) const {
            return glm::all(glm::lessThanEqual(minimum, other.maximum)) &&
                   glm::all(glm::lessThanEqual(other.minimum, maximum));
        }
    };
    /// One part of the scene's solids.
    struct Place {
        Nearness nearness;
        glm::mat3 toCells;  ///< world → cells: toCells·p + offset
        glm::vec3 offset;
        Box box;  ///< of the cells, in the world
    };
    [[nodiscard]] static Place placeOf(Nearness nearness, const glm::mat4& toWorld);
    [[nodiscard]] bool nearAny(const std::vector<std::uint32_t>& places, const glm::vec3& point) const;
    [[nodiscard]] std::vector<std::uint32_t> placesMeeting(const Box& box) const;

    Impact impact_;
    float reachMetres_;
    meshes::TriangleTree tree_;
    std::vector<Place> places_;
    std::size_t off_ = 0;
};

}  // namespace dustbench::voxel_shape
