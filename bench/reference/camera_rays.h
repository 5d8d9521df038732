// The rays through an image's pixel centres, in double precision, and how far along them the opaque scene is.
//
// Units: metres, slopes (lateral metres per metre ahead). The ray of a pixel is t·(slopeX, slopeY, 1)/√(1 + slopeX² +
// slopeY²), t being the distance from the eye. Threads: pure.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/view.h"

namespace dustbench::reference {

/// Frame: camera axes (x right, y up, z ahead), origin at the eye. The axes are those of scene::View, which has them in
/// single precision only.
class CameraRays {
 public:
    /// Throws std::invalid_argument for an image without pixels or a camera with non-finite values.
    explicit CameraRays(const scene::View& view);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// Slopes of the centre of a column and of a row; rows from the top.
    [[nodiscard]] double columnSlope(int x) const { return slopeX(x + 0.5); }
    [[nodiscard]] double rowSlope(int y) const { return slopeY(y + 0.5); }
    [[nodiscard]] double slopeX(double pixelX) const { return (2 * pixelX / width_ - 1) * limitX_; }
    [[nodiscard]] double slopeY(double pixelY) const { return (1 - 2 * pixelY / height_) * limitY_; }
    /// Pixel coordinates of a slope: the inverse of slopeX and slopeY.
    [[nodiscard]] double pixelX(double slopeX) const { return (slopeX / limitX_ + 1) / 2 * width_; }
    [[nodiscard]] double pixelY(double slopeY) const { return (1 - slopeY / limitY_) / 2 * height_; }
    /// Transforms a position from world to camera frame.
    [[nodiscard]] glm::dvec3 fromWorld(const glm::dvec3& position) const { return turned(position - eye_); }
    /// Transforms a direction from world to camera frame.
    [[nodiscard]] glm::dvec3 turned(const glm::dvec3& v) const {
        return {glm::dot(v, right_), glm::dot(v, up_), glm::dot(v, ahead_)};
    }
    /// Unit vector, in world coordinates.
    [[nodiscard]] glm::dvec3 direction(int x, int y) const {
        return glm::normalize(ahead_ + columnSlope(x) * right_ + rowSlope(y) * up_);
    }

 private:
    int width_, height_;
    glm::dvec3 eye_, right_{1, 0, 0}, up_{0, 1, 0}, ahead_{0, 0, -1};
    double limitX_, limitY_;  ///< slopes at the image's right and upper edge
};

/// Distance of the opaque scene along each pixel's ray, where integration of the dust ends: Euclidean from the eye
/// along the ray (not along the camera's axis). Rows from the top.
struct OpaqueDistances {
    int width = 0;
    int height = 0;
    std::vector<double> metres;  ///< width·height; +inf for sky
};

/// From a reversed depth image, rows from the top: depth = near / distance along the axis, 0 is the sky. With the
/// slopes x, y of the pixel's ray, the distance is near/depth·√(1 + x² + y²). Exact for the given depth;
/// single-precision reversed depth itself is accurate to 6e-8 of the distance. Throws std::invalid_argument if the
/// number of values is not view.width·view.height, and for depths outside [0, 1] or NaN.
[[nodiscard]] OpaqueDistances distancesFromDepth(const scene::View& view, std::span<const float> depth);

/// No opaque scene: all sky.
[[nodiscard]] OpaqueDistances skyDistances(const scene::View& view);

/// Throws std::invalid_argument unless `distances` fits the view and every distance is 0 or more (+inf included).
void checkDistances(const scene::View& view, const OpaqueDistances& distances);

}  // namespace dustbench::reference
