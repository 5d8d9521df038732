#include "methods/kit/particles/ground_surface.h"

#include <algorithm>
#include <cmath>

namespace dustbench::particles {
namespace {

/// Contacts with the plane y = 0.
void meetPlane(std::size_t count, const float* __restrict fromY, const float* __restrict toY, float* __restrict share) {
    for (std::size_t i = 0; i < count; ++i) {
        const float at = fromY[i] > 0.0f ? fromY[i] / (fromY[i] - toY[i]) : 0.0f;
        share[i] = ((toY[i] < 0.0f) & (toY[i] < fromY[i])) ? at : Surface::none;
    }
}

/// A path over the height field, in units of its grid.
struct GridWay {
    const scene::Terrain& terrain;
    glm::dvec3 from, way;  ///< x and z in cells, y in metres

    /// Height above the surface of the cell (column, row) at share s; beyond the edge the surface continues level.
    [[nodiscard]] double above(double s, int column, int row) const {
        const auto columns = static_cast<std::size_t>(terrain.columns());
        const double u = std::clamp(from.x + s * way.x, 0.0, static_cast<double>(terrain.columns() - 1)) - column;
        const double v = std::clamp(from.z + s * way.z, 0.0, static_cast<double>(terrain.rows() - 1)) - row;
        const float* h = &terrain.heights()[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)];
        const double near = (1 - u) * static_cast<double>(h[0]) + u * static_cast<double>(h[1]);
        const double far = (1 - u) * static_cast<double>(h[columns]) + u * static_cast<double>(h[columns + 1]);
        return from.y + s * way.y - ((1 - v) * near + v * far);
    }
    /// The smallest s > `after` at which a coordinate reaches a whole number; at most 1.
    [[nodiscard]] double nextLine(double after) const {
        double next = 1;
        for (const int axis : {0, 2}) {
            if (way[axis] == 0) continue;
            const double at = from[axis] + after * way[axis];
            double line = way[axis] > 0 ? std::floor(at) + 1 : std::ceil(at) - 1;
            double s = (line - from[axis]) / way[axis];
            if (s <= after) s = (line + (way[axis] > 0 ? 1 : -1) - from[axis]) / way[axis];
            next = std::min(next, s);
        }
        return next;
    }
};

/// The first s in [a, b] where the parabola through f(a), f(middle), f(b) falls below 0; negative: none. Within a cell,
/// the height above a bilinear surface is exactly such a parabola.
double fallsBelow(double fa, double fm, double fb) {
    const double c = fa, b = 4 * fm - 3 * fa - fb, a = 2 * (fa + fb) - 4 * fm;  // f = a·t² + b·t + c, t = 0..1
    const double square = b * b - 4 * a * c;
    if (square < 0) return -1;
    // The root at which f falls: 2c / (−b + √…).
    const double t = 2 * c / (-b + std::sqrt(square));
    return t >= 0 && t <= 1 ? t : -1;
}

float meetField(const glm::vec3& from, const glm::vec3& to, const scene::Terrain& terrain) {
    const double perCell = 1 / static_cast<double>(terrain.spacingMetres());
    const auto toGrid = [&](const glm::vec3& p) {
        return glm::dvec3((static_cast<double>(p.x) - static_cast<double>(terrain.origin().x)) * perCell, p.y,
                          (static_cast<double>(p.z) - static_cast<double>(terrain.origin().y)) * perCell);
    };
    const GridWay way{terrain, toGrid(from), toGrid(to) - toGrid(from)};
    for (double s = 0; s < 1;) {
        const double end = way.nextLine(s), middle = (s + end) / 2;
        const int column = static_cast<int>(
            std::clamp(std::floor(way.from.x + middle * way.way.x), 0.0, static_cast<double>(terrain.columns() - 2)));
        const int row = static_cast<int>(
            std::clamp(std::floor(way.from.z + middle * way.way.z), 0.0, static_cast<double>(terrain.rows() - 2)));
        const double before = way.above(s, column, row), after = way.above(end, column, row);
        if (s == 0 && before <= 0) {
            if (after < before) return 0;  // starts below and moves deeper: contact at once
        } else if (const double t = fallsBelow(before, way.above(middle, column, row), after); t >= 0) {
            return static_cast<float>(s + t * (end - s));
        }
        s = end;
    }
    return Surface::none;
}

}  // namespace

void meetGround(const Ways& ways, const scene::Terrain& terrain, float* share) {
    if (terrain.isFlat()) return meetPlane(ways.count, ways.fromY, ways.toY, share);
    for (std::size_t i = 0; i < ways.count; ++i) share[i] = meetField(ways.from(i), ways.to(i), terrain);
}

}  // namespace dustbench::particles
