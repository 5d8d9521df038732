#include "methods/shared/draw/shadow_footprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace dustbench::draw {
namespace {

constexpr double leastSunHeight = 0.1;  // sine of 6°
constexpr int samplesAcross = 9;
constexpr double binMetres = 8;  // triangles this near to each other stand together

void take(GroundRectangle& rectangle, const glm::dvec3& point) {
    rectangle.least = glm::min(rectangle.least, glm::dvec2(point.x, point.z));
    rectangle.most = glm::max(rectangle.most, glm::dvec2(point.x, point.z));
}

/// Lowest of a few heights under the rectangle.
double lowestGround(const GroundRectangle& rectangle, const scene::Terrain& terrain) {
    if (terrain.isFlat()) return 0;
    double lowest = INFINITY;
    for (int j = 0; j < samplesAcross; ++j)
        for (int i = 0; i < samplesAcross; ++i) {
            const glm::dvec2 share = glm::dvec2(i, j) / (samplesAcross - 1.0);
            const glm::dvec2 place = glm::mix(rectangle.least, rectangle.most, share);
            const float height = terrain.heightAt(static_cast<float>(place.x), static_cast<float>(place.y));
            lowest = std::min(lowest, static_cast<double>(height));
        }
    return lowest;
}

}  // namespace

GroundRectangle shadowFootprint(const glm::vec3& least, const glm::vec3& most, const glm::dmat4& toWorld,
                                const glm::vec3& toSun, const scene::Terrain& terrain, double marginMetres) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = glm::dvec3(
            toWorld * glm::dvec4(i & 1 ? most.x : least.x, i & 2 ? most.y : least.y, i & 4 ? most.z : least.z, 1));
    GroundRectangle box{glm::dvec2(INFINITY), glm::dvec2(-INFINITY)};
    for (const glm::dvec3& corner : corners) take(box, corner);

    // p − s·(p.y − ground)/s.y; the ground under the shadow is known once the shadow is: two rounds.
    const glm::dvec3 slant = glm::dvec3(toSun) / std::max(static_cast<double>(toSun.y), leastSunHeight);
    GroundRectangle shadow = box;
    for (int round = 0; round < 2; ++round) {
        const double ground = lowestGround(shadow, terrain);
        for (const glm::dvec3& corner : corners) take(shadow, corner - slant * std::max(corner.y - ground, 0.0));
    }
    return {shadow.least - marginMetres, shadow.most + marginMetres};
}

std::vector<GroundRectangle> shadowFootprints(const scene::Mesh& mesh, const glm::dmat4& toWorld,
                                              const glm::vec3& toSun, const scene::Terrain& terrain,
                                              double marginMetres) {
    struct Bounds {
        glm::vec3 least{INFINITY}, most{-INFINITY};
    };
    std::map<std::pair<std::int64_t, std::int64_t>, Bounds> bins;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const auto corner = [&](std::size_t n) { return glm::vec3(mesh.positions[mesh.indices[i + n]]); };
        const glm::dvec3 place(toWorld * glm::dvec4((corner(0) + corner(1) + corner(2)) / 3.0f, 1));
        Bounds& bounds = bins[{std::llround(place.x / binMetres), std::llround(place.z / binMetres)}];
        for (const std::size_t n : {0, 1, 2}) {
            bounds.least = glm::min(bounds.least, corner(n));
            bounds.most = glm::max(bounds.most, corner(n));
        }
    }
    std::vector<GroundRectangle> result;
    for (const auto& [bin, bounds] : bins)
        result.push_back(shadowFootprint(bounds.least, bounds.most, toWorld, toSun, terrain, marginMetres));
    joinOverlapping(result);
    return result;
}

void joinOverlapping(std::vector<GroundRectangle>& rectangles) {
    const auto overlap = [](const GroundRectangle& a, const GroundRectangle& b) {
        return a.least.x < b.most.x && b.least.x < a.most.x && a.least.y < b.most.y && b.least.y < a.most.y;
    };
    for (std::size_t i = 0; i < rectangles.size();) {
        const auto other = std::find_if(rectangles.begin() + static_cast<std::ptrdiff_t>(i) + 1, rectangles.end(),
                                        [&](const GroundRectangle& each) { return overlap(rectangles[i], each); });
        if (other == rectangles.end()) {
            ++i;
            continue;
        }
        rectangles[i] = {glm::min(rectangles[i].least, other->least), glm::max(rectangles[i].most, other->most)};
        rectangles.erase(other);
        i = 0;  // the larger one may overlap what the smaller did not
    }
}

}  // namespace dustbench::draw
