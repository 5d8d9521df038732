// One number a pixel: a channel of a picture, an alpha, or the map of a metric.
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

/// What a metric says of one frame, and where it comes from.
struct Measured {
    std::optional<double> value;  ///< empty where the metric is not defined; never NaN
    Plane map;                    ///< what `value` sums up; each metric says which range it has
};

}  // namespace dustbench::bench
