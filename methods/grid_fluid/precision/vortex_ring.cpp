#include "methods/grid_fluid/precision/vortex_ring.h"

#include <cmath>
#include <numbers>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::precision {
namespace {

constexpr int segments = 64;

/// A = Γ/4π ∮ dl / √(d² + a²)
class Potential {
 public:
    explicit Potential(const VortexRing& ring) : squareOfCore_(ring.coreMetres * ring.coreMetres) {
        for (int s = 0; s < segments; ++s) {
            const double turn = 2 * std::numbers::pi * (s + 0.5) / segments;
            const glm::dvec3 outwards(0, std::cos(turn), std::sin(turn)), along(0, -outwards.z, outwards.y);
            places_[static_cast<std::size_t>(s)] = ring.centreMetres + ring.radiusMetres * outwards;
            // Γ/4π times the length of a segment: Γ·R/(2·segments)
            strengths_[static_cast<std::size_t>(s)] =
                along * (ring.circulationM2PerSecond * ring.radiusMetres / (2 * segments));
        }
    }
    [[nodiscard]] glm::dvec3 at(const glm::dvec3& place) const {
        glm::dvec3 sum(0);
        for (std::size_t s = 0; s < places_.size(); ++s) {
            const glm::dvec3 d = place - places_[s];
            sum += strengths_[s] / std::sqrt(glm::dot(d, d) + squareOfCore_);
        }
        return sum;
    }

 private:
    double squareOfCore_;
    std::array<glm::dvec3, segments> places_{}, strengths_{};
};

}  // namespace

double VortexRing::distanceMetres(const glm::dvec3& place) const {
    const glm::dvec3 d = place - centreMetres;
    return std::hypot(d.x, std::hypot(d.y, d.z) - radiusMetres);
}

void addRing(const VortexRing& ring, const flow::FluidBox& box, StaggeredFlow& flow) {
    const Potential potential(ring);
    const double h = box.spacingMetres;
    const glm::ivec3 corners = box.cells + 1;
    const auto edgeAt = [&](int axis, const glm::ivec3& corner) {
        glm::dvec3 middle(corner);
        middle[axis] += 0.5;
        return potential.at(box.originMetres + middle * h)[axis];
    };
    // The potential of the edges along y and z from each corner; along x it is 0.
    const auto index = [&](const glm::ivec3& corner) {
        return (static_cast<std::size_t>(corner.z) * static_cast<std::size_t>(corners.y) +
                static_cast<std::size_t>(corner.y)) *
                   static_cast<std::size_t>(corners.x) +
               static_cast<std::size_t>(corner.x);
    };
    std::vector<double> y(index({0, 0, corners.z})), z(y.size());
    parallel::forEachBlock(static_cast<std::size_t>(corners.z), 1, [&](std::size_t slab, std::size_t) {
        for (glm::ivec3 c(0, 0, static_cast<int>(slab)); c.y < corners.y; ++c.y)
            for (c.x = 0; c.x < corners.x; ++c.x) {
                y[index(c)] = edgeAt(1, c);
                z[index(c)] = edgeAt(2, c);
            }
    });
    const glm::ivec3 nextX(1, 0, 0), nextY(0, 1, 0), nextZ(0, 0, 1);
    const auto forFaces = [&](int axis, const auto& circulation) {
        const glm::ivec3 faces = flow.faces(axis);
        for (glm::ivec3 c(0); c.z < faces.z; ++c.z)
            for (c.y = 0; c.y < faces.y; ++c.y)
                for (c.x = 0; c.x < faces.x; ++c.x)
                    flow.speeds[static_cast<std::size_t>(axis)][flow.face(axis, c.x, c.y, c.z)] +=
                        static_cast<float>(circulation(c) / h);
    };
    forFaces(
        0, [&](const glm::ivec3& c) { return z[index(c + nextY)] - z[index(c)] - y[index(c + nextZ)] + y[index(c)]; });
    forFaces(1, [&](const glm::ivec3& c) { return z[index(c)] - z[index(c + nextX)]; });
    forFaces(2, [&](const glm::ivec3& c) { return y[index(c + nextX)] - y[index(c)]; });
}

}  // namespace dustbench::grid_fluid::precision
