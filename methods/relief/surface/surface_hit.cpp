#include "methods/relief/surface/surface_hit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dustbench::relief {
namespace {

/// A line in a patch: place(t) = from + t·way, relative to the patch's lower left corner.
struct LineInPatch {
    glm::dvec3 from, way;
    double corner[2][2];  ///< depths, [right][upper]

    /// Coefficients of d(t) − D(t) = a·t² + b·t + c.
    [[nodiscard]] glm::dvec3 gap() const {
        const double base = corner[0][0], alongU = corner[1][0] - base, alongV = corner[0][1] - base;
        const double twist = corner[1][1] - corner[1][0] - corner[0][1] + base;
        return {-twist * way.x * way.y,
                way.z - alongU * way.x - alongV * way.y - twist * (from.x * way.y + from.y * way.x),
                from.z - base - alongU * from.x - alongV * from.y - twist * from.x * from.y};
    }
};

double valueAt(const glm::dvec3& quadratic, double t) {
    return (quadratic.x * t + quadratic.y) * t + quadratic.z;
}

/// The first t in [begin, end] with a·t² + b·t + c ≥ 0.
std::optional<double> firstNotNegative(const glm::dvec3& quadratic, double begin, double end) {
    if (valueAt(quadratic, begin) >= 0) return begin;
    const auto [a, b, c] = std::array{quadratic.x, quadratic.y, quadratic.z};
    std::optional<double> first;
    const auto offer = [&](double root) {
        if (root >= begin && root <= end && (!first || root < *first)) first = root;
    };
    const double discriminant = b * b - 4 * a * c;
    if (a == 0) {
        if (b != 0) offer(-c / b);
    } else if (discriminant >= 0) {
        const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));  // without cancellation
        offer(q / a);
        if (q != 0) offer(c / q);
    }
    if (!first && valueAt(quadratic, end) >= 0) first = end;  // a root lost to rounding
    return first;
}

/// Steps through the unit cells along one axis: the point where the line leaves the current cell, and the side.
struct Axis {
    Axis(double from, double way)
        : cell(static_cast<int>(std::floor(from))),
          step(way > 0 ? 1 : -1),
          next(way == 0 ? HUGE_VAL : ((way > 0 ? cell + 1 : cell) - from) / way),
          spacing(way == 0 ? HUGE_VAL : 1 / std::abs(way)) {}

    void advance() {
        cell += step;
        next += spacing;
    }

    int cell, step;
    double next, spacing;
};

}  // namespace

std::optional<double> firstHit(const DepthMap& map, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 way = to - from;
    Axis u(from.x, way.x), v(from.y, way.y);
    double begin = 0;
    while (true) {
        const double end = std::min({u.next, v.next, 1.0});
        const LineInPatch line{{from.x - u.cell, from.y - v.cell, from.z},
                               way,
                               {{map.at(u.cell, v.cell), map.at(u.cell, v.cell + 1)},
                                {map.at(u.cell + 1, v.cell), map.at(u.cell + 1, v.cell + 1)}}};
        if (const auto hit = firstNotNegative(line.gap(), begin, std::max(begin, end))) return hit;
        if (end >= 1) return std::nullopt;
        begin = std::max(begin, end);
        (u.next < v.next ? u : v).advance();
    }
}

}  // namespace dustbench::relief
