// What the metrics work on: planes, prepared pictures and drawn primitives, and the checks of them.
//
// Checks throw InputError with one line that names the image: a file, or its role.
// Units: pixels; display-encoded sRGB values in [0, 1]. Frame: rows from the top, x to the right; the upper left corner
// is (0, 0), the first pixel's centre (0.5, 0.5). Threads: preparation uses the current oneTBB arena; the result is
// bit-identical at any number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/pictures/image.h"

namespace dustbench::measure {

/// One number per pixel: a channel of a picture, an alpha, or the map of a metric.
template <typename Number>
struct PlaneOf {
    int width = 0;
    int height = 0;
    std::vector<Number> values;

    PlaneOf() = default;
    PlaneOf(int planeWidth, int planeHeight)
        : width(planeWidth),
          height(planeHeight),
          values(static_cast<std::size_t>(planeWidth) * static_cast<std::size_t>(planeHeight)) {}

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] const Number& at(int x, int y) const { return values[index(x, y)]; }
    [[nodiscard]] Number& at(int x, int y) { return values[index(x, y)]; }
    [[nodiscard]] const Number* row(int y) const { return values.data() + index(0, y); }
    [[nodiscard]] Number* row(int y) { return values.data() + index(0, y); }
};

using Plane = PlaneOf<float>;

/// The value of a metric for one frame, and its distribution over the picture.
struct Measured {
    std::optional<double> value;  ///< empty if the metric is undefined; never NaN
    Plane map;                    ///< the per-pixel values behind `value`; each metric documents their range
};

/// An opaque picture prepared for the metrics: checked and display-encoded once.
struct Picture {
    std::string name;  ///< for messages: a file, or its role
    int width = 0;
    int height = 0;
    std::array<Plane, 3> linear;   ///< red, green, blue; as given, so it may be below 0 or above 1
    std::array<Plane, 3> encoded;  ///< of `linear` clamped to [0, 1]
    Plane luma;                    ///< 0.2126 R + 0.7152 G + 0.0722 B of the encoded values (Rec. 709)
};

/// Throws InputError if it has no pixels, or some are not finite or not opaque.
[[nodiscard]] Picture preparePicture(const pictures::Image& image, const std::string& name);

/// Throws InputError.
void requireSameSize(const Picture& picture, const Picture& other);

/// Screen position and size of one drawn primitive: a billboard, a voxel, a puff.
struct ScreenPrimitive {
    double xPixels = 0;
    double yPixels = 0;
    double radiusPixels = 0;  ///< of the puff, not of the quad around it
};

/// The alpha above which a pixel counts as dust, for all metrics that exclude empty parts of the picture: two and a
/// half steps of an 8-bit picture over black.
inline constexpr float dustAlpha = 0.01f;

// --- Checks: at least one pixel, all finite, equal sizes, opaque or with a valid alpha

/// Tolerance of alpha around 1, and outside [0, 1]: a layer over a scene sums to 1 only within rounding.
inline constexpr float alphaTolerance = 1e-3f;

/// The message gives the number of pixels with a non-finite channel, and the first such pixel.
void requireFinite(const pictures::Image& image, std::string_view name);
void requireFinite(const Plane& plane, std::string_view name);

void requireOpaque(const pictures::Image& image, std::string_view name);

void requireSameSize(int width, int height, std::string_view name, int otherWidth, int otherHeight,
                     std::string_view otherName);
void requireSameSize(const Plane& plane, std::string_view name, const Plane& other, std::string_view otherName);

/// The alpha of a layer: checked to lie in [0, 1] within the tolerance, then clamped.
[[nodiscard]] Plane alphaOf(const pictures::Image& layer, std::string_view name);

}  // namespace dustbench::measure
