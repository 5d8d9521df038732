#include "methods/voxel_shape/voxels/solid_space.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace dustbench::voxel_shape {
namespace {

/// Returns 1 if the ray upwards from `p` leaves through the triangle (counter-clockwise as seen from outside), −1 if it
/// enters, 0 if it misses.
int crossing(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p) {
    // Seen from above, the ray is a point that spans these areas with the triangle's edges. For an edge shared by two
    // triangles, the two areas are exactly opposite, to the last bit.
    const auto area = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return (from.z - p.z) * (to.x - p.x) - (from.x - p.x) * (to.z - p.z);
    };
    const double ofA = area(b, c), ofB = area(c, a), ofC = area(a, b), all = ofA + ofB + ofC;
    const bool around = (ofA > 0 && ofB > 0 && ofC > 0) || (ofA < 0 && ofB < 0 && ofC < 0);
    if (!around || (ofA * a.y + ofB * b.y + ofC * c.y) / all <= p.y) return 0;
    return all > 0 ? 1 : -1;
}

double minimumX(const std::array<glm::dvec3, 3>& triangle) {
    return std::min({triangle[0].x, triangle[1].x, triangle[2].x});
}
double maximumX(const std::array<glm::dvec3, 3>& triangle) {
    return std::max({triangle[0].x, triangle[1].x, triangle[2].x});
}

}  // namespace

SolidSpace::SolidSpace(const scene::Scene& scene) {
    for (std::size_t i = 0; i < scene.solids.size(); ++i)
        add(*scene.solids[i].mesh, glm::dmat4(scene.solidPoses[i].toWorld));
}

void SolidSpace::add(const scene::Mesh& mesh, const glm::dmat4& toWorld) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Body body{{}, glm::dvec3(infinity), glm::dvec3(-infinity), 0};
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        Triangle& triangle = body.triangles.emplace_back();
        for (std::size_t corner = 0; corner < 3; ++corner) {
            triangle[corner] = glm::dvec3(toWorld * glm::dvec4(mesh.positions[mesh.indices[k + corner]], 1));
            body.minimum = glm::min(body.minimum, triangle[corner]);
            body.maximum = glm::max(body.maximum, triangle[corner]);
        }
        body.widest = std::max(body.widest, maximumX(triangle) - minimumX(triangle));
    }
    std::ranges::sort(body.triangles, {}, minimumX);
    bodies_.push_back(std::move(body));
}

int SolidSpace::exits(const Body& body, const glm::dvec3& point) {
    const auto first = std::ranges::lower_bound(body.triangles, point.x - body.widest, {}, minimumX);
    const auto last = std::ranges::upper_bound(body.triangles, point.x, {}, minimumX);
    int sum = 0;
    for (auto triangle = first; triangle < last; ++triangle)
        sum += crossing((*triangle)[0], (*triangle)[1], (*triangle)[2], point);
    return sum;
}

bool SolidSpace::contains(const glm::dvec3& point) const {
    return std::ranges::any_of(bodies_, [&](const Body& body) {
        return glm::all(glm::greaterThanEqual(point, body.minimum)) &&
               glm::all(glm::lessThanEqual(point, body.maximum)) && exits(body, point) > 0;
    });
}

}  // namespace dustbench::voxel_shape
