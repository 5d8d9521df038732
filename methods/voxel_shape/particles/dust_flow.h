// Drags a shape's particles along with the dust that drifts through it.
//
// The dust's velocities are distributed on a coarse lattice around the shape, each puff to the eight nodes around it. A
// particle's velocity approaches their mean at its position: v ← v + s·min(1, w)·(u − v), w: number of puffs there.
// Source: JuckelBeckhaus2007, 7 (`fluid dynamics were not added yet`). Units: m/s. Frame: nodes in the shape's own,
// velocities in the world's. Owns: its nodes, on a ledger. Threads: one caller at a time; uses the current oneTBB
// arena; the result does not depend on the number of threads.
#pragma once

#include "methods/contract/volume.h"
#include "methods/voxel_shape/particles/shape_system.h"

namespace dustbench::voxel_shape {

class DustFlow {
 public:
    explicit DustFlow(MemoryLedger& ledger) : nodes_(ledger.account("flow")) {}

    /// Applies the equation above; shape and dust must be at the same time. `share`: s.
    void drawAlong(ShapeSystem& moved, const Puffs& dust, float share);

 private:
    struct Node {
        glm::vec3 velocity{0};  ///< sum over the puffs, weighted
        float weight = 0;
    };
    /// Calls `visit(node, weight)` for the eight nodes around a place, which is in cells.
    template <typename Nodes, typename Visit>
    void forNodesAround(Nodes& nodes, const glm::vec3& place, const Visit& visit) const;

    LedgerVector<Node> nodes_;
    glm::ivec3 counts_{0};
};

}  // namespace dustbench::voxel_shape
