// A shape's pose from moment to moment: along its track, in the vehicle's frame or the world's, with the velocities
// that the difference between two moments gives.
//
// Units: m, s, radians. Frame: world.
#pragma once

#include <optional>

#include "methods/contract/scene.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {

/// Place, heading and scale at a time: linear from key to key, from the last back to the first one at once.
[[nodiscard]] TrackKey keyAt(const Track& track, double timeSeconds);

class ShapeTrack {
 public:
    explicit ShapeTrack(const Track& track) : track_(track) {}

    /// The pose of the next moment, `stepSeconds` after the last one; at rest in the first.
    Pose advance(const scene::SceneState& state, double stepSeconds);

 private:
    Track track_;
    std::optional<Pose> last_;
};

}  // namespace dustbench::voxel_shape
