// Moves a camera by hand. Pure functions.
//
// Units: m, radians. Frame: world, +Y up.
#pragma once

#include "bench/world/cameras.h"

namespace dustbench::view {

/// The pose of a camera as a key.
[[nodiscard]] world::CameraKey keyOf(const scene::Camera& camera, double seconds);

/// Turns the eye about the target: by `turn` about the vertical, counter-clockwise seen from above, and by `rise`
/// upwards, but never to the vertical.
[[nodiscard]] world::CameraKey turned(const world::CameraKey& key, double turn, double rise);
/// Moves the eye to `factor` times its distance from the target, at least 0.2 m.
[[nodiscard]] world::CameraKey dollied(const world::CameraKey& key, double factor);
/// Moves eye and target by `right` and `up` in the plane of the picture.
[[nodiscard]] world::CameraKey shifted(const world::CameraKey& key, double right, double up);

}  // namespace dustbench::view
