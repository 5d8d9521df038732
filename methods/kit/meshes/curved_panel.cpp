#include "methods/kit/meshes/curved_panel.h"

namespace dustbench::meshes {
namespace {

constexpr int steps = 12;  // Newton's method doubles the digits in each
constexpr double solvedMetres = 1e-13;

/// Normal to the face, of length ≥ 1.
glm::dvec3 acrossFace(const scene::Panel& panel, const glm::dvec3& relief) {
    return {panel.curvaturePerMetre * glm::dvec2(relief), 1};
}

}  // namespace

glm::dvec3 fromRelief(const scene::Panel& panel, const glm::dvec3& relief) {
    if (!isCurved(panel)) return relief;
    const glm::dvec2 at(relief);
    const glm::dvec3 face(at, -0.5 * glm::dot(panel.curvaturePerMetre, at * at));
    return face + relief.z * glm::normalize(acrossFace(panel, relief));
}

glm::dmat3 reliefAxes(const scene::Panel& panel, const glm::dvec3& relief) {
    if (!isCurved(panel)) return glm::dmat3(1);
    const glm::dvec2 curvature = panel.curvaturePerMetre;
    const glm::dvec3 across = acrossFace(panel, relief);
    const double length = glm::length(across);
    const glm::dvec3 normal = across / length;
    // ∂n/∂x = (∂N/∂x − n·(n·∂N/∂x))/|N|
    const auto turned = [&](const glm::dvec3& change) { return (change - normal * glm::dot(normal, change)) / length; };
    return {glm::dvec3(1, 0, -across.x) + relief.z * turned({curvature.x, 0, 0}),
            glm::dvec3(0, 1, -across.y) + relief.z * turned({0, curvature.y, 0}), normal};
}

glm::dvec3 toRelief(const scene::Panel& panel, const glm::dvec3& place) {
    if (!isCurved(panel)) return place;
    const glm::dvec2 at(place);
    glm::dvec3 relief(at, place.z + 0.5 * glm::dot(panel.curvaturePerMetre, at * at));
    for (int step = 0; step < steps; ++step) {
        const glm::dvec3 apart = place - fromRelief(panel, relief);
        relief += glm::inverse(reliefAxes(panel, relief)) * apart;
        if (glm::dot(apart, apart) < solvedMetres * solvedMetres) break;
    }
    return relief;
}

PlateBounds boundsOf(const scene::Panel& panel) {
    const glm::dvec2 half = panel.sizeMetres / 2.0, curvature = panel.curvaturePerMetre;
    PlateBounds bounds{{-half, -panel.depthMetres}, {half, 0}};
    for (int axis = 0; axis < 2; ++axis) {
        const double sag = -0.5 * curvature[axis] * half[axis] * half[axis];
        (sag < 0 ? bounds.low : bounds.high).z += sag;
        // The plate's depth is along the normal. That of a hollow face leans outwards at the rim.
        if (curvature[axis] < 0) {
            const double lean = panel.depthMetres * -curvature[axis] * half[axis];
            bounds.low[axis] -= lean;
            bounds.high[axis] += lean;
        }
    }
    return bounds;
}

}  // namespace dustbench::meshes
