// Screen position and size of one drawn primitive: a billboard, a voxel, a puff.
//
// Units: pixels. Frame: the picture's upper left corner is (0, 0); the first pixel's centre is (0.5, 0.5).
#pragma once

namespace dustbench::bench {

struct ScreenPrimitive {
    double xPixels = 0;
    double yPixels = 0;
    double radiusPixels = 0;  ///< of the puff, not of the quad around it
};

}  // namespace dustbench::bench
