// What drags a shape's particles along: another shape, the dust that drifts through it, a velocity field from files.
//
// The law is that of air drag, v ← v + s·(u − v), u: the velocity of that which drags at the particle, s: `share`.
// Source: JuckelBeckhaus2007, 7 (`interaction between more than one particle system should be implemented`, `fluid
// dynamics were not added yet`). Departs: the paper gives no law.
//
// Units: m/s. Frame: world. Threads: one caller at a time; uses the current oneTBB arena; the result does not depend on
// the number of threads.
#pragma once

#include "methods/contract/volume.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/kit/volumes/vector_series.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/particles/shape_system.h"

namespace dustbench::voxel_shape {

/// Another shape: applies the law to the particles of `moved` in voxels of `by` that are switched on; both shapes must
/// be at the same time. Returns the number of those particles. The result does not depend on the order of the shapes: a
/// particle sees the other shapes' voxels, never their particles.
std::size_t drawAlong(ShapeSystem& moved, const ShapeSystem& by, float share);

/// The dust: its velocities are distributed on a coarse lattice around the shape, each puff to the eight nodes around
/// it. A particle's velocity approaches their mean at its position: v ← v + s·min(1, w)·(u − v), w: number of puffs
/// there. Owns: its nodes, in the shape's own frame, on a ledger.
class DustFlow {
 public:
    explicit DustFlow(MemoryLedger& ledger) : nodes_(ledger.account("flow")) {}

    /// Applies the equation above; shape and dust must be at the same time.
    void drawAlong(ShapeSystem& moved, const Puffs& dust, float share);

 private:
    struct Node {
        glm::vec3 velocity{0};  ///< in the world, sum over the puffs, weighted
        float weight = 0;
    };
    /// Calls `visit(node, weight)` for the eight nodes around a place, which is in cells.
    template <typename Nodes, typename Visit>
    void forNodesAround(Nodes& nodes, const glm::vec3& place, const Visit& visit) const;

    LedgerVector<Node> nodes_;
    glm::ivec3 counts_{0};
};

/// A field: u(x, t) is trilinear in space and linear in time; particles outside the field's grid are unchanged.
/// `timeSeconds`: time in the series.
void drawAlong(particles::ParticleStore& moved, const volumes::VectorSeries& flow, double timeSeconds, float share);
/// The same with a field in the frame of a shape at this pose, with which it moves: u is relative to the shape, whose
/// scale lengthens it.
void drawAlong(particles::ParticleStore& moved, const volumes::VectorSeries& flow, const Pose& pose, double timeSeconds,
               float share);

}  // namespace dustbench::voxel_shape
