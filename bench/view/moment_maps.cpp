#include "bench/view/moment_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "bench/export/collected_volume.h"
#include "bench/measure/clock.h"
#include "bench/measure/image/flaw_metrics.h"
#include "bench/measure/image/heat_map.h"
#include "bench/measure/image/picture.h"
#include "bench/measure/image/picture_error.h"
#include "bench/reference/camera_rays.h"
#include "bench/reference/judge/moment_pictures.h"
#include "bench/view/split_view.h"
#include "methods/kit/draw/read_back.h"

namespace dustbench::view {
namespace {

measure::Measured flipOf(const ViewSession& session) {
    if (session.isExact(Half::b) && session.isEvaluated() && session.exact().whyNotEvaluated().empty()) {
        const reference::EvaluatedMoment& evaluated = session.exact().evaluated();
        return {evaluated.metrics.values.of("flip"), evaluated.difference};
    }
    return measure::flip(measure::preparePicture(session.image(Half::b), "the picture of B"),
                         measure::preparePicture(session.image(Half::a), "the picture of A"));
}

bool isFinite(const glm::vec4& value) {
    return std::isfinite(value.r) && std::isfinite(value.g) && std::isfinite(value.b) && std::isfinite(value.a);
}

constexpr double quadHalfSide = 1.5;  // of the radius
constexpr float darkened = 0.3f;
/// Share of the light below that one outline lets through.
constexpr float seenThrough = 0.45f;
/// Linear light. Colour-blind readers can distinguish them.
const glm::vec3 quadColour(0.87f, 0.76f, 0.05f), voxelColour(0.09f, 0.46f, 0.81f);

/// Adds 1 to every pixel of the line except the last one, so that an outline of several lines counts corners once.
void addLine(measure::Plane& plane, glm::dvec2 from, glm::dvec2 to) {
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
void addEdge(measure::Plane& plane, const reference::CameraRays& rays, double nearMetres, glm::dvec3 from,
             glm::dvec3 to) {
    if (from.z < to.z) std::swap(from, to);
    if (!(from.z > nearMetres)) return;
    if (to.z < nearMetres) to = glm::mix(from, to, (from.z - nearMetres) / (from.z - to.z));
    const auto pixel = [&rays](const glm::dvec3& place) {
        return glm::dvec2(rays.pixelX(place.x / place.z), rays.pixelY(place.y / place.z));
    };
    addLine(plane, pixel(from), pixel(to));
}

void addQuad(measure::Plane& plane, const glm::dvec2& centre, double half) {
    const glm::dvec2 right(half, 0), up(0, half);
    const std::array corners{centre - right - up, centre + right - up, centre + right + up, centre - right + up};
    for (std::size_t i = 0; i < corners.size(); ++i) addLine(plane, corners[i], corners[(i + 1) % corners.size()]);
}

void addVoxel(measure::Plane& plane, const reference::CameraRays& rays, double nearMetres, const glm::dvec3& minimum,
              double edge) {
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

LayerFaults faultsOf(const pictures::Image& layer) {
    LayerFaults faults;
    for (std::size_t i = 0; i < layer.pixels.size(); ++i) {
        const glm::vec4& pixel = layer.pixels[i];
        if (!isFinite(pixel))
            ++faults.notFinite;
        else if (pixel.r < 0 || pixel.g < 0 || pixel.b < 0)
            ++faults.negative;
        else if (pixel.a < -measure::alphaTolerance || pixel.a > 1 + measure::alphaTolerance)
            ++faults.alpha;
        else
            continue;
        const int index = static_cast<int>(i);
        if (!faults.first) faults.first = glm::ivec2(index % layer.width, index / layer.width);
    }
    return faults;
}

void MomentMaps::fit(gpu::Texture& texture, const char* label, const ViewSession& session) {
    const results::ImageSize size = session.state().size;
    if (texture.width() != size.width || texture.height() != size.height)
        texture = gpu::Texture::make2D(device_, label, gpu::Format::rgba8, size.width, size.height);
}

const gpu::Texture& MomentMaps::flip(const ViewSession& session) {
    if (flipMoment_ != session.drawnMoment()) makeFlip(session);
    return flip_;
}

void MomentMaps::makeFlip(const ViewSession& session) {
    const std::int64_t start = measure::steadyNow();
    const measure::Measured measured = flipOf(session);
    fit(flip_, "FLIP", session);
    upload(measure::heatMap(measured.map), flip_);
    flipMean_ = measured.value;
    flipSeconds_ = static_cast<double>(measure::steadyNow() - start) / 1e9;
    flipMoment_ = session.drawnMoment();
}

const gpu::Texture& MomentMaps::overdraw(ViewSession& session, Half half) {
    if (overdrawMoment_ != session.drawnMoment()) makeOverdraw(session);
    return overdraw_.at(half == Half::a ? 0 : 1);
}

void MomentMaps::makeOverdraw(ViewSession& session) {
    const results::ImageSize size = session.state().size;
    std::array<measure::Plane, 2> maps;
    float maximum = 1;
    for (const Half half : {Half::a, Half::b}) {
        measure::Plane& map = maps.at(half == Half::a ? 0 : 1);
        map = measure::Plane(size.width, size.height);
        if (!session.hasHost(half)) continue;
        exports::CollectedVolume volume;
        session.volume(half, volume);
        map = measure::overdrawMap(reference::primitivesOnScreen(volume, session.view()), size.width, size.height);
        maximum = std::max(maximum, std::ranges::max(map.values));
    }
    for (std::size_t i = 0; i < maps.size(); ++i) {
        fit(overdraw_[i], "overdraw", session);
        upload(measure::heatMap(maps[i], 0, maximum), overdraw_[i]);
    }
    overdrawLimit_ = static_cast<double>(maximum);
    overdrawMoment_ = session.drawnMoment();
}

const gpu::Texture& MomentMaps::outlines(ViewSession& session, Half half) {
    const std::size_t index = half == Half::a ? 0 : 1;
    gpu::Texture& texture = outlines_.at(index);
    if (outlinesMoment_.at(index) == session.drawnMoment()) return texture;
    exports::CollectedVolume volume;
    if (session.hasHost(half)) session.volume(half, volume);
    fit(texture, "outlines", session);
    upload(withOutlines(session.image(half), outlinesOf(volume, session.view())), texture);
    outlinesMoment_.at(index) = session.drawnMoment();
    return texture;
}

const LayerFaults& MomentMaps::faults(const ViewSession& session, Half half) {
    const std::size_t index = half == Half::a ? 0 : 1;
    if (faultsMoment_.at(index) != session.drawnMoment()) {
        faults_.at(index) = faultsOf(draw::readBack(session.textures(half).layer));
        faultsMoment_.at(index) = session.drawnMoment();
    }
    return faults_.at(index);
}

Outlines outlinesOf(const exports::CollectedVolume& volume, const scene::View& view) {
    const reference::CameraRays rays(view);
    const double pixelsPerSlope = rays.pixelX(1) - rays.pixelX(0);
    const double nearMetres = view.camera.nearMetres;
    Outlines outlines{measure::Plane(view.width, view.height), measure::Plane(view.width, view.height)};
    for (const exports::CollectedPuff& puff : volume.puffs()) {
        const glm::dvec3 place = rays.fromWorld(glm::dvec3(puff.centre));
        if (place.z <= nearMetres) continue;
        addQuad(outlines.quads, {rays.pixelX(place.x / place.z), rays.pixelY(place.y / place.z)},
                quadHalfSide * static_cast<double>(puff.radiusMetres) / place.z * pixelsPerSlope);
    }
    for (const exports::CollectedOctree& octree : volume.octrees())
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

}  // namespace dustbench::view
