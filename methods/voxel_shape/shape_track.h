// A shape's pose from moment to moment: along its track, in the vehicle's frame or the world's, with the velocities of
// that very moment.
//
// Units: m, s, radians. Frame: world.
#pragma once

#include <optional>

#include "methods/contract/scene.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {

/// Place, heading and scale at a time: linear from key to key, from the last back to the first one at once.
struct TrackMoment {
    TrackKey key;
    TrackKey perSecond;  ///< how place, heading and scale change; going back to the first key is a jump, not a motion
};
[[nodiscard]] TrackMoment momentAt(const Track& track, double timeSeconds);

class ShapeTrack {
 public:
    explicit ShapeTrack(const Track& track) : track_(track) {}

    /// The pose of the next moment, `stepSeconds` after the last one. How fast the vehicle turns is the turn since
    /// then: none in the first.
    Pose advance(const scene::SceneState& state, double stepSeconds);

 private:
    Track track_;
    std::optional<glm::dmat3> lastFrame_;
};

}  // namespace dustbench::voxel_shape
