// One number per pixel: a channel of a picture, an alpha, or the map of a metric.
//
// Frame: rows from the top, x to the right.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace dustbench::bench {

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

}  // namespace dustbench::bench
