// A shape in a flow: its particles are drawn along by the dust that drifts through it.
//
// The dust's velocities are shared out over a coarse lattice about the shape, each puff over the eight nodes around it,
// and a particle is drawn towards their mean at its place, v ← v + s·min(1, w)·(u − v), w: puffs there.
// Source: JuckelBeckhaus2007, 7 (`fluid dynamics were not added yet`). Units: m/s. Frame: nodes in the shape's own,
// velocities in the world's. Owns: its nodes, on a ledger. Threads: one caller at a time; uses the current oneTBB
// arena, and the result is the same at any number of threads.
#pragma once

#include "methods/contract/volume.h"
#include "methods/voxel_shape/particles/shape_system.h"

namespace dustbench::voxel_shape {

class DustFlow {
 public:
    explicit DustFlow(MemoryLedger& ledger) : nodes_(ledger.account("flow")) {}

    /// Both at one moment. `share`: of the difference of velocities that is taken away where puffs are.
    void drawAlong(ShapeSystem& moved, const Puffs& dust, float share);

 private:
    struct Node {
        glm::vec3 velocity{0};  ///< sum
        float weight = 0;
    };
    /// Calls `visit(node, weight)` for the eight nodes around a place in cells.
    template <typename Nodes, typename Visit>
    void forNodesAround(Nodes& nodes, const glm::vec3& place, const Visit& visit) const;

    LedgerVector<Node> nodes_;
    glm::ivec3 counts_{0};
};

}  // namespace dustbench::voxel_shape
