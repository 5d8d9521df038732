// One shape in a scene: its track, voxels, particles, light and collisions.
//
// Units: m, s, radians. Frame: world. Owns: all of it, on a ledger. Threads: the OpenGL thread's; uses the current
// oneTBB arena.
#pragma once

#include <memory>
#include <optional>

#include "methods/contract/method.h"
#include "methods/contract/scene.h"
#include "methods/kit/volumes/vector_series.h"
#include "methods/voxel_shape/collision/shape_collision.h"
#include "methods/voxel_shape/particles/draw_along.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/particles/shape_system.h"
#include "methods/voxel_shape/shape.h"
#include "methods/voxel_shape/shape_colours.h"

namespace dustbench::voxel_shape {

/// Position, heading and scale at a time: linear from key to key, with a jump from the last key back to the first.
struct TrackMoment {
    TrackKey key;
    TrackKey perSecond;  ///< rates of position, heading and scale; the jump to the first key does not count
};
[[nodiscard]] TrackMoment momentAt(const Track& track, double timeSeconds);

/// A shape's pose over time along its track, in the vehicle's frame or the world's, with the velocities at the same
/// time.
class ShapeTrack {
 public:
    explicit ShapeTrack(const Track& track) : track_(track) {}

    /// Returns the pose `stepSeconds` after the last one. The vehicle's rate of turn is the turn since the last call; 0
    /// at the first call.
    Pose advance(const scene::SceneState& state, double stepSeconds);

 private:
    Track track_;
    std::optional<glm::dmat3> lastFrame_;
};

class LivingShape {
 public:
    explicit LivingShape(const Shape& shape) : shape_(shape), track_(shape.track) {}

    /// Throws InputError if the shape does not fit the scene. `ledger` must outlive this object.
    void prepare(MemoryLedger& ledger, const scene::Scene& scene, gpu::Device& device, std::uint64_t seed);
    /// Advances to the frame's time.
    void step(const Frame& frame);

    [[nodiscard]] const Shape& shape() const { return shape_; }
    [[nodiscard]] const ShapeSystem& system() const { return *system_; }
    [[nodiscard]] ShapeSystem& system() { return *system_; }
    /// Throws std::runtime_error if the number of particles held deviates more from the shape's number than requested.
    void requireNumberHeld() const;
    /// Memory of the collision solids and the flow; the rest is on the ledger.
    [[nodiscard]] MemoryReport memory() const;

 private:
    Shape shape_;
    ShapeTrack track_;
    std::optional<ShapeSystem> system_;
    std::optional<ShapeLight> light_;
    std::optional<ShapeStress> stress_;
    std::optional<DustFlow> flow_;
    std::optional<volumes::VectorSeries> field_;
    std::optional<FlowWake> wake_;
    std::unique_ptr<ShapeCollision> collision_;
};

}  // namespace dustbench::voxel_shape
