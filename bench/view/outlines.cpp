#include "bench/view/outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "bench/reference/camera_rays.h"

namespace dustbench::bench {
namespace {

constexpr double quadHalfSide = 1.5;  // of the radius
constexpr float darkened = 0.3f;
/// Share of the light below that one outline lets through.
constexpr float seenThrough = 0.45f;
/// Linear light. Colour-blind readers can distinguish them.
const glm::vec3 quadColour(0.87f, 0.76f, 0.05f), voxelColour(0.09f, 0.46f, 0.81f);

/// Adds 1 to every pixel of the line except the last one, so that an outline of several lines counts corners once.
void addLine(Plane& plane, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 way = to - from;
    // Clipped to the picture first (Liang and Barsky), so that the cost of a line depends only on its visible part.
    double begin = 0, end = 1;
    const glm::dvec2 size(plane.width, plane.height);
    for (int axis = 0; axis < 2; ++axis) {
        if (way[axis] == 0) {
            if (from[axis] < 0 || from[axis] >= size[axis]) return;
            continue;
        }
        const double atZero = -from[axis] / way[axis], atSize = (size[axis] - from[axis]) / way[axis];
        begin = std::max(begin, std::min(atZero, atSize));
        end = std::min(end, std::max(atZero, atSize));
    }
    if (!(begin < end)) return;
    const auto steps = static_cast<int>(std::ceil(std::max(std::abs(way.x), std::abs(way.y)) * (end - begin)));
    for (int n = 0; n < steps; ++n) {
        const glm::dvec2 at = from + way * (begin + (end - begin) * (n + 0.5) / steps);
        plane.at(std::clamp(static_cast<int>(at.x), 0, plane.width - 1),
                 std::clamp(static_cast<int>(at.y), 0, plane.height - 1)) += 1;
    }
}

/// Draws a line between points in the camera's frame, clipped at the near plane.
void addEdge(Plane& plane, const CameraRays& rays, double nearMetres, glm::dvec3 from, glm::dvec3 to) {
    if (from.z < to.z) std::swap(from, to);
    if (!(from.z > nearMetres)) return;
    if (to.z < nearMetres) to = glm::mix(from, to, (from.z - nearMetres) / (from.z - to.z));
    const auto pixel = [&rays](const glm::dvec3& place) {
        return glm::dvec2(rays.pixelX(place.x / place.z), rays.pixelY(place.y / place.z));
    };
    addLine(plane, pixel(from), pixel(to));
}

void addQuad(Plane& plane, const glm::dvec2& centre, double half) {
    const glm::dvec2 right(half, 0), up(0, half);
    const std::array corners{centre - right - up, centre + right - up, centre + right + up, centre - right + up};
    for (std::size_t i = 0; i < corners.size(); ++i) addLine(plane, corners[i], corners[(i + 1) % corners.size()]);
}

void addVoxel(Plane& plane, const CameraRays& rays, double nearMetres, const glm::dvec3& minimum, double edge) {
    // Corner i has bit 0 of i along x, bit 1 along y, bit 2 along z.
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = rays.fromWorld(minimum + edge * glm::dvec3(i & 1, i >> 1 & 1, i >> 2 & 1));
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (const std::size_t along : {1u, 2u, 4u})
            if ((i & along) == 0) addEdge(plane, rays, nearMetres, corners[i], corners[i | along]);
}

glm::vec3 over(const glm::vec3& below, const glm::vec3& colour, float lines) {
    return glm::mix(colour, below, std::pow(seenThrough, lines));
}

}  // namespace

Outlines outlinesOf(const CollectedVolume& volume, const scene::View& view) {
    const CameraRays rays(view);
    const double pixelsPerSlope = rays.pixelX(1) - rays.pixelX(0);
    const double nearMetres = view.camera.nearMetres;
    Outlines outlines{Plane(view.width, view.height), Plane(view.width, view.height)};
    for (const CollectedPuff& puff : volume.puffs()) {
        const glm::dvec3 place = rays.fromWorld(glm::dvec3(puff.centre));
        if (place.z <= nearMetres) continue;
        addQuad(outlines.quads, {rays.pixelX(place.x / place.z), rays.pixelY(place.y / place.z)},
                quadHalfSide * static_cast<double>(puff.radiusMetres) / place.z * pixelsPerSlope);
    }
    for (const CollectedOctree& octree : volume.octrees())
        for (const OctreeVoxel& voxel : octree.voxels)
            addVoxel(outlines.voxels, rays, nearMetres, octree.minimumCorner(voxel),
                     octree.cellEdgeMetres(voxel.level));
    return outlines;
}

pictures::Image withOutlines(pictures::Image picture, const Outlines& outlines) {
    if (picture.width != outlines.quads.width || picture.height != outlines.quads.height)
        throw std::invalid_argument("outlines: picture and outlines differ in size");
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const glm::vec3 dark = darkened * glm::vec3(picture.pixels[i]);
        picture.pixels[i] = glm::vec4(
            over(over(dark, quadColour, outlines.quads.values[i]), voxelColour, outlines.voxels.values[i]), 1);
    }
    return picture;
}

}  // namespace dustbench::bench
