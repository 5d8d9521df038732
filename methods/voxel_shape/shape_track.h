// A shape's pose over time along its track, in the vehicle's frame or the world's, with the velocities at the same
// time.
//
// Units: m, s, radians. Frame: world.
#pragma once

#include <optional>

#include "methods/contract/scene.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {

/// Position, heading and scale at a time: linear from key to key, with a jump from the last key back to the first.
struct TrackMoment {
    TrackKey key;
    TrackKey perSecond;  ///< rates of position, heading and scale; the jump to the first key does not count
};
[[nodiscard]] TrackMoment momentAt(const Track& track, double timeSeconds);

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

}  // namespace dustbench::voxel_shape
