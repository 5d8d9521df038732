// What drags a shape's particles along: another shape, the dust that drifts through it, a velocity field from files.
// The field's air can lose the momentum that the particles gain.
//
// The law is that of air drag, v ← v + s·(u − v), u: the velocity of that which drags at the particle, s: `share`.
// Source: JuckelBeckhaus2007, 7 (`interaction between more than one particle system should be implemented`, `fluid
// dynamics were not added yet`). Departs: the paper gives no law.
//
// Units: m/s. Frame: world. Threads: one caller at a time; uses the current oneTBB arena; the result does not depend on
// the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <optional>

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

/// A coarse lattice of nodes around a shape, in the shape's own frame, with one more cell on each side, to include
/// particles that have just left.
struct NodesAround {
    explicit NodesAround(const Lattice& voxels);

    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(counts.x) * static_cast<std::size_t>(counts.y) *
               static_cast<std::size_t>(counts.z);
    }
    /// A point of the shape's frame in cells.
    [[nodiscard]] glm::vec3 cellsOf(const glm::vec3& local) const { return (local - origin) / edgeMetres; }
    /// Calls `visit(node, weight)` for the eight nodes around a place, which is in cells; for none outside the lattice.
    template <typename Nodes, typename Visit>
    void around(Nodes& nodes, const glm::vec3& place, const Visit& visit) const;

    glm::ivec3 counts;
    glm::vec3 origin;
    float edgeMetres;
};

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
    LedgerVector<Node> nodes_;
};

/// The flow's velocity u at a point in the world; empty outside the flow. Threads: any.
using Flow = std::function<std::optional<glm::vec3>(const glm::vec3&)>;

/// A field at a time of its series: trilinear in space and linear in time, none outside its grid. Valid as long as the
/// series.
[[nodiscard]] Flow flowOf(const volumes::VectorSeries& field, double timeSeconds);
/// The same with a field in the frame of a shape at this pose, with which it moves: it is relative to the shape, whose
/// scale lengthens it.
[[nodiscard]] Flow flowOf(const volumes::VectorSeries& field, const Pose& pose, double timeSeconds);

/// Applies the law to particles where there is a flow.
void drawAlong(particles::ParticleStore& moved, const Flow& flow, float share);

/// How a shape's particles act back on the flow u that drags them along. The air around a node has the velocity u + w,
/// and loses the momentum that the particles gain:
///
///     v ← v + (1 − e^{−k(1+L)Δt})/(1 + L)·(u + w − v),   w ← w − Σ λ·Δv,   λ: mass of a particle by that of a node's
///     air
///
/// L is the mass of the particles by that of the air at the particle, so that the relative velocity falls at the rate
/// k(1 + L), as that of two bodies does. The wake w then moves with the air and fades: w ← e^{−Δt/T}·w(x − (u + w)Δt).
///
/// Owns: the nodes, in the shape's own frame, on a ledger. Source: CroweEtAl1977 (particles as sources of
/// momentum in cells). Departs: no pressure, so the wake diverges.
class FlowWake {
 public:
    /// `massLoading`: mass of the particles of a full voxel by that of its air. `fadeSeconds`: T.
    FlowWake(MemoryLedger& ledger, float massLoading, float fadeSeconds);

    /// Applies the first line to particles and nodes. `drawsPerSecond`: k.
    void exchange(ShapeSystem& moved, const Flow& flow, float drawsPerSecond, float seconds);
    /// Moves and fades the wake.
    void carry(const ShapeSystem& around, const Flow& flow, float seconds);

    /// Sum over the nodes of the momentum of the wake, with the mass of a particle as the unit.
    [[nodiscard]] glm::dvec3 momentumInParticles(const ShapeSystem& around) const;
    /// w at a point of the world.
    [[nodiscard]] glm::vec3 at(const ShapeSystem& around, const glm::vec3& world) const;

 private:
    [[nodiscard]] float particleByNode(const ShapeSystem& around, const NodesAround& lattice) const;

    float massLoading_, fadeSeconds_;
    LedgerVector<glm::vec3> wake_, next_;
    LedgerVector<float> loading_;     ///< L at the nodes
    LedgerVector<glm::vec3> gained_;  ///< Δv of each particle
};

}  // namespace dustbench::voxel_shape
