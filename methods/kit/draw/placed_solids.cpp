#include "methods/kit/draw/placed_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>

#include "methods/kit/draw/panel_pass.h"

namespace dustbench::draw {
namespace {

constexpr double footprintMarginMetres = 0.3;  // a few of the shadow map's texels
constexpr double minimumSunHeight = 0.1;       // sine of 6°
constexpr int samplesAcross = 9;
constexpr double binMetres = 8;  // triangles in the same bin form one group

void take(GroundRectangle& rectangle, const glm::dvec3& point) {
    rectangle.minimum = glm::min(rectangle.minimum, glm::dvec2(point.x, point.z));
    rectangle.maximum = glm::max(rectangle.maximum, glm::dvec2(point.x, point.z));
}

/// The lowest of several height samples under the rectangle.
double lowestGround(const GroundRectangle& rectangle, const scene::Terrain& terrain) {
    if (terrain.isFlat()) return 0;
    double lowest = INFINITY;
    for (int j = 0; j < samplesAcross; ++j)
        for (int i = 0; i < samplesAcross; ++i) {
            const glm::dvec2 share = glm::dvec2(i, j) / (samplesAcross - 1.0);
            const glm::dvec2 place = glm::mix(rectangle.minimum, rectangle.maximum, share);
            const float height = terrain.heightAt(static_cast<float>(place.x), static_cast<float>(place.y));
            lowest = std::min(lowest, static_cast<double>(height));
        }
    return lowest;
}

}  // namespace

PlacedSolids::PlacedSolids(const scene::Scene& scene, gpu::Device& device) : scene_(scene) {
    if (scene.solidPoses.size() != scene.solids.size())
        throw std::invalid_argument("OpaqueScene: every solid needs a pose");
    std::map<const scene::Mesh*, std::shared_ptr<SolidMesh>> shapes;
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        const scene::Solid& solid = scene.solids[i];
        PlacedSolid placed;
        if (solid.motion != scene::SolidMotion::still) placed.moving = i;
        if (solid.motion == scene::SolidMotion::deforms) {
            placed.mesh = std::make_shared<SolidMesh>(device, solid);
        } else {
            std::shared_ptr<SolidMesh>& shape = shapes[solid.mesh.get()];
            if (!shape) shape = std::make_shared<SolidMesh>(device, solid);
            placed.mesh = shape;
        }
        add(*solid.mesh, scene.solidPoses[i].toWorld, std::move(placed));
    }
    for (const scene::Panel& panel : scene.panels) {
        if (panel.parent != scene::Panel::Parent::world) continue;
        const auto plate = std::make_shared<const scene::Mesh>(panelPlate(panel));
        PlacedSolid placed;
        placed.mesh = std::make_shared<SolidMesh>(device, scene::Solid{panel.name, plate});
        placed.castsOnly = true;
        add(*plate, glm::mat4(panel.toParent), std::move(placed));
    }
    joinFootprints();
}

bool PlacedSolids::moveTo(const scene::SceneState& state) {
    bool anyMoved = false;
    for (PlacedSolid& placed : all_) {
        if (!placed.moving || *placed.moving >= state.solids.size()) continue;
        const scene::SolidNow& solid = state.solids[*placed.moving];
        if (placed.toWorld == solid.pose.toWorld && placed.deformed == solid.shape) continue;
        const scene::Mesh& shape = scene::solidMesh(scene_, state, *placed.moving);
        if (placed.deformed != solid.shape) placed.mesh->reshape(shape);
        placed.deformed = solid.shape;
        place(placed, shape, solid.pose.toWorld);
        anyMoved = true;
    }
    if (anyMoved) joinFootprints();
    return anyMoved;
}

void PlacedSolids::add(const scene::Mesh& shape, const glm::mat4& pose, PlacedSolid solid) {
    place(solid, shape, pose);
    all_.push_back(std::move(solid));
}

void PlacedSolids::place(PlacedSolid& solid, const scene::Mesh& shape, const glm::mat4& pose) {
    solid.toWorld = pose;
    solid.centre = glm::dvec3(pose * glm::vec4(solid.mesh->centre(), 1));
    solid.radiusMetres = static_cast<double>(solid.mesh->radiusMetres() * glm::length(glm::vec3(pose[0])));
    solid.footprints = shadowFootprints(shape, pose, scene_.lights.toSun, scene_.terrain, footprintMarginMetres);
}

void PlacedSolids::joinFootprints() {
    footprints_.clear();
    for (const PlacedSolid& solid : all_)
        footprints_.insert(footprints_.end(), solid.footprints.begin(), solid.footprints.end());
    joinOverlapping(footprints_);
}

GroundRectangle shadowFootprint(const glm::vec3& minimum, const glm::vec3& maximum, const glm::dmat4& toWorld,
                                const glm::vec3& toSun, const scene::Terrain& terrain, double marginMetres) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = glm::dvec3(toWorld * glm::dvec4(i & 1 ? maximum.x : minimum.x, i & 2 ? maximum.y : minimum.y,
                                                     i & 4 ? maximum.z : minimum.z, 1));
    GroundRectangle box{glm::dvec2(INFINITY), glm::dvec2(-INFINITY)};
    for (const glm::dvec3& corner : corners) take(box, corner);

    // p − s·(p.y − ground)/s.y. The ground height depends on the shadow's extent: two iterations.
    const glm::dvec3 slant = glm::dvec3(toSun) / std::max(static_cast<double>(toSun.y), minimumSunHeight);
    GroundRectangle shadow = box;
    for (int round = 0; round < 2; ++round) {
        const double ground = lowestGround(shadow, terrain);
        for (const glm::dvec3& corner : corners) take(shadow, corner - slant * std::max(corner.y - ground, 0.0));
    }
    return {shadow.minimum - marginMetres, shadow.maximum + marginMetres};
}

std::vector<GroundRectangle> shadowFootprints(const scene::Mesh& mesh, const glm::dmat4& toWorld,
                                              const glm::vec3& toSun, const scene::Terrain& terrain,
                                              double marginMetres) {
    struct Bounds {
        glm::vec3 minimum{INFINITY}, maximum{-INFINITY};
    };
    std::map<std::pair<std::int64_t, std::int64_t>, Bounds> bins;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const auto corner = [&](std::size_t n) { return glm::vec3(mesh.positions[mesh.indices[i + n]]); };
        const glm::dvec3 place(toWorld * glm::dvec4((corner(0) + corner(1) + corner(2)) / 3.0f, 1));
        Bounds& bounds = bins[{std::llround(place.x / binMetres), std::llround(place.z / binMetres)}];
        for (const std::size_t n : {0, 1, 2}) {
            bounds.minimum = glm::min(bounds.minimum, corner(n));
            bounds.maximum = glm::max(bounds.maximum, corner(n));
        }
    }
    std::vector<GroundRectangle> result;
    result.reserve(bins.size());
    for (const auto& [bin, bounds] : bins)
        result.push_back(shadowFootprint(bounds.minimum, bounds.maximum, toWorld, toSun, terrain, marginMetres));
    joinOverlapping(result);
    return result;
}

void joinOverlapping(std::vector<GroundRectangle>& rectangles) {
    const auto overlap = [](const GroundRectangle& a, const GroundRectangle& b) {
        return a.minimum.x < b.maximum.x && b.minimum.x < a.maximum.x && a.minimum.y < b.maximum.y &&
               b.minimum.y < a.maximum.y;
    };
    for (std::size_t i = 0; i < rectangles.size();) {
        const auto other = std::find_if(rectangles.begin() + static_cast<std::ptrdiff_t>(i) + 1, rectangles.end(),
                                        [&](const GroundRectangle& each) { return overlap(rectangles[i], each); });
        if (other == rectangles.end()) {
            ++i;
            continue;
        }
        rectangles[i] = {glm::min(rectangles[i].minimum, other->minimum),
                         glm::max(rectangles[i].maximum, other->maximum)};
        rectangles.erase(other);
        i = 0;  // the merged rectangle may overlap others
    }
}

}  // namespace dustbench::draw
