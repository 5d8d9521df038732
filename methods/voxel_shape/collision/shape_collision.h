// Keeps a shape's particles out of the scene's solids and its vehicle, in three steps: the shape's bounding box; then
// its voxels, which are switched off while they touch one of them; then the path of each particle near one against its
// triangles (a wheel is the cylinder of its outline). Solids that move or deform do so during the step.
//
// A particle that hits a surface stops one millimetre in front of it, and a surface that moves carries it for the rest
// of the step. Relative to the surface, the normal component of its velocity is reversed and scaled by `restitution`;
// the tangential component is scaled by 1 − `friction`. In addition it gets up to `scatter` times the normal speed in
// its own random tangential direction, so that a shape bursts.
//
// Units: m, m/s, s. Frame: world. Owns: the solids' trees and grids. Threads: one caller at a time; uses the current
// oneTBB arena; the result does not depend on the number of threads.
// Source: JuckelBeckhaus2007, 5.2. Departs: the paper gives no response.
#pragma once

#include "methods/contract/memory_report.h"
#include "methods/contract/scene.h"
#include "methods/kit/particles/scene_surface.h"
#include "methods/voxel_shape/collision/solid_places.h"
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
    /// `voxelMetres`: the largest edge that the shape's voxels will have in the world. The scene must outlive this
    /// object.
    ShapeCollision(const scene::Scene& scene, float voxelMetres, const Impact& impact, const Collidable& with = {});

    /// Moves solids and vehicle to the end of a step; call first in each step.
    void moveTo(const scene::SceneState& state, double stepSeconds);
    /// The first two steps: switches off the voxels that touch a solid, and switches on the others.
    void switchVoxels(VoxelGrid& grid, const Pose& pose);
    /// The third step, right after the particles moved by `stepSeconds` of their velocity. Returns the number of hits.
    std::size_t stopParticles(ShapeParticles& particles, float stepSeconds) const;

    /// Returns the number of voxels that are switched off now.
    [[nodiscard]] std::size_t switchedOff() const { return off_; }
    [[nodiscard]] MemoryReport memory() const;

 private:
    const scene::Scene* scene_;
    Impact impact_;
    particles::SceneSurface surface_;
    SolidPlaces places_;
    std::size_t off_ = 0;
};

}  // namespace dustbench::voxel_shape
