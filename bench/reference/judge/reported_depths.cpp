#include "bench/reference/judge/reported_depths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bench/reference/camera_rays.h"
#include "bench/reference/depth_sum.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::reference {
namespace {

constexpr std::size_t rowsAtOnce = 4;

/// A pixel's ray: eye + t·direction, as far as the opaque scene.
struct Ray {
    glm::dvec3 eye, direction, inverse;
    double endMetres;
};

Ray rayOf(const CameraRays& rays, const glm::dvec3& eye, int x, int y, double endMetres) {
    Ray ray{eye, rays.direction(x, y), {}, endMetres};
    // A ray along a face must not become NaN.
    for (int axis = 0; axis < 3; ++axis)
        ray.inverse[axis] = 1 / (ray.direction[axis] == 0 ? 1e-300 : ray.direction[axis]);
    return ray;
}

struct Span {
    double begin, end;
    [[nodiscard]] double length() const { return std::max(end - begin, 0.0); }
};

/// The interval of the ray within a box.
Span within(const Ray& ray, const glm::dvec3& minimum, const glm::dvec3& maximum) {
    const glm::dvec3 a = (minimum - ray.eye) * ray.inverse, b = (maximum - ray.eye) * ray.inverse;
    const glm::dvec3 first = glm::min(a, b), last = glm::max(a, b);
    return {std::max({first.x, first.y, first.z, 0.0}), std::min({last.x, last.y, last.z, ray.endMetres})};
}

/// A voxel in world coordinates, and the pixels that it may touch: [first, end) of columns and rows.
struct Cube {
    glm::dvec3 minimum, maximum;
    double extinctionPerMetre;
    int firstColumn, endColumn, firstRow, endRow;
};

/// The pixels around the corners of a convex body; all pixels if a corner is not in front of the eye.
void findPixels(Cube& cube, const CameraRays& rays) {
    double left = std::numeric_limits<double>::infinity(), right = -left, top = left, bottom = -left;
    double nearest = left, farthest = -left;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place =
            rays.fromWorld({corner & 1 ? cube.minimum.x : cube.maximum.x, corner & 2 ? cube.minimum.y : cube.maximum.y,
                            corner & 4 ? cube.minimum.z : cube.maximum.z});
        nearest = std::min(nearest, place.z);
        farthest = std::max(farthest, place.z);
        const double x = rays.pixelX(place.x / place.z), y = rays.pixelY(place.y / place.z);
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
    }
    constexpr double inFrontMetres = 1e-6;
    const auto pixels = [&](double from, double to, int count, int& first, int& end) {
        if (nearest < inFrontMetres) {
            first = 0;
            end = farthest > 0 ? count : 0;
        } else {
            first = static_cast<int>(std::clamp(std::floor(from - 0.5), 0.0, static_cast<double>(count)));
            end = static_cast<int>(std::clamp(std::ceil(to + 0.5), 0.0, static_cast<double>(count)));
        }
    };
    pixels(left, right, rays.width(), cube.firstColumn, cube.endColumn);
    pixels(top, bottom, rays.height(), cube.firstRow, cube.endRow);
}

std::vector<Cube> cubesOf(const exports::CollectedVolume& volume, const CameraRays& rays) {
    std::vector<Cube> cubes;
    for (const exports::CollectedOctree& octree : volume.octrees())
        for (const OctreeVoxel& voxel : octree.voxels) {
            const glm::dvec3 corner = octree.minimumCorner(voxel);
            Cube cube{corner,
                      corner + octree.cellEdgeMetres(voxel.level),
                      static_cast<double>(voxel.extinctionPerMetre),
                      0,
                      0,
                      0,
                      0};
            findPixels(cube, rays);
            cubes.push_back(cube);
        }
    return cubes;
}

/// Walks from cell to cell along the ray.
double depthThrough(const exports::CollectedGrid& grid, const Ray& ray) {
    const double spacing = grid.spacingMetres;
    const Span span = within(ray, grid.originMetres, grid.originMetres + glm::dvec3(grid.cells) * spacing);
    if (!(span.end > span.begin)) return 0;
    const glm::dvec3 entry = (ray.eye + span.begin * ray.direction - grid.originMetres) / spacing;
    glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(entry)), glm::ivec3(0), grid.cells - 1);
    glm::dvec3 next;  // t at the face through which the ray leaves the cell, by axis
    glm::ivec3 step;
    for (int axis = 0; axis < 3; ++axis) {
        step[axis] = ray.direction[axis] < 0 ? -1 : 1;
        const double face = grid.originMetres[axis] + (cell[axis] + (step[axis] > 0 ? 1 : 0)) * spacing;
        next[axis] = (face - ray.eye[axis]) * ray.inverse[axis];
    }
    const glm::dvec3 perCell = glm::abs(ray.inverse) * spacing;
    double depth = 0;
    for (double at = span.begin; at < span.end;) {
        const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
        const double leave = std::clamp(next[axis], at, span.end);
        depth +=
            static_cast<double>(grid.extinctionPerMetre[grid.row(cell.y, cell.z) + static_cast<std::size_t>(cell.x)]) *
            (leave - at);
        at = leave;
        cell[axis] += step[axis];
        if (cell[axis] < 0 || cell[axis] >= grid.cells[axis]) break;
        next[axis] += perCell[axis];
    }
    return depth;
}

/// The optical depths of the volume's puffs.
std::vector<double> depthsOfPuffs(const std::vector<exports::CollectedPuff>& puffs, const CameraRays& rays,
                                  const OpaqueDistances& distances) {
    std::vector<std::uint64_t> serial;
    std::array<std::vector<float>, 5> columns;
    for (const exports::CollectedPuff& puff : puffs) {
        serial.push_back(serial.size());
        const std::array values{puff.centre.x, puff.centre.y, puff.centre.z, puff.radiusMetres, puff.opacity};
        for (std::size_t i = 0; i < values.size(); ++i) columns[i].push_back(values[i]);
    }
    Puffs store;
    store.serial = serial;
    store.x = columns[0];
    store.y = columns[1];
    store.z = columns[2];
    store.radius = columns[3];
    store.opacity = columns[4];
    constexpr double toleratedDepth = 1e-6;
    return sumDepths(preparePuffs(store, rays, 1, neglectedDepth(toleratedDepth, store.size())), rays, distances)
        .depths;
}

}  // namespace

std::vector<double> reportedDepths(const exports::CollectedVolume& volume, const scene::View& view,
                                   const OpaqueDistances& distances) {
    checkDistances(view, distances);
    const CameraRays rays(view);
    std::vector<double> depths(distances.metres.size());
    if (!volume.puffs().empty()) depths = depthsOfPuffs(volume.puffs(), rays, distances);
    const std::vector<Cube> cubes = cubesOf(volume, rays);
    if (cubes.empty() && volume.grids().empty()) return depths;
    const auto width = static_cast<std::size_t>(view.width);
    parallel::forEachBlock(
        static_cast<std::size_t>(view.height), rowsAtOnce, [&](std::size_t firstRow, std::size_t count) {
            std::vector<Ray> row(width);
            for (std::size_t y = firstRow; y < firstRow + count; ++y) {
                double* const sums = depths.data() + y * width;
                for (std::size_t x = 0; x < width; ++x)
                    row[x] = rayOf(rays, view.camera.eye, static_cast<int>(x), static_cast<int>(y),
                                   distances.metres[y * width + x]);
                for (const Cube& cube : cubes) {
                    if (static_cast<int>(y) < cube.firstRow || static_cast<int>(y) >= cube.endRow) continue;
                    for (auto x = static_cast<std::size_t>(cube.firstColumn);
                         x < static_cast<std::size_t>(cube.endColumn); ++x)
                        sums[x] += cube.extinctionPerMetre * within(row[x], cube.minimum, cube.maximum).length();
                }
                for (const exports::CollectedGrid& grid : volume.grids())
                    for (std::size_t x = 0; x < width; ++x) sums[x] += depthThrough(grid, row[x]);
            }
        });
    return depths;
}

measure::Plane reportedAlpha(const exports::CollectedVolume& volume, const scene::View& view,
                             const OpaqueDistances& distances) {
    measure::Plane alpha(view.width, view.height);
    const std::vector<double> depths = reportedDepths(volume, view, distances);
    std::ranges::transform(depths, alpha.values.begin(),
                           [](double depth) { return static_cast<float>(-std::expm1(-depth)); });
    return alpha;
}

}  // namespace dustbench::reference
