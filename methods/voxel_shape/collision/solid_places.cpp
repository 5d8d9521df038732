#include "methods/voxel_shape/collision/solid_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <numeric>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/voxel_shape/voxels/solid_fill.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"

namespace dustbench::voxel_shape {
namespace {

/// Disjoint sets of numbers; a set is represented by its minimum.
class Groups {
 public:
    explicit Groups(std::size_t count) : leader_(count) { std::iota(leader_.begin(), leader_.end(), std::size_t{0}); }
    [[nodiscard]] std::size_t of(std::size_t i) {
        while (leader_[i] != i) i = leader_[i] = leader_[leader_[i]];
        return i;
    }
    /// Joins two sets; returns whether they were separate.
    bool join(std::size_t a, std::size_t b) {
        a = of(a), b = of(b);
        leader_[std::max(a, b)] = std::min(a, b);
        return a != b;
    }

 private:
    std::vector<std::size_t> leader_;
};

constexpr int maximumCells = 128;

MarkedVoxels surfaceOf(const scene::Mesh& mesh, float cellMetres) {
    const Lattice one = latticeAround(mesh, 1);  // its edge is the longest side
    const int cells = std::clamp(static_cast<int>(std::ceil(one.edgeMetres / cellMetres)), 1, maximumCells);
    return surfaceVoxels(mesh, latticeAround(mesh, cells));
}

float scaleOf(const glm::mat4& toWorld) {
    return glm::length(glm::vec3(toWorld[0]));
}

/// A prism around the outline of a wheel, which the spokes do not fill. Axis: z.
scene::Mesh wheelOutline(float radius, float halfWidth) {
    constexpr std::uint32_t sides = 24;
    scene::Mesh mesh;
    const float corner = radius / std::cos(glm::pi<float>() / sides);
    for (std::uint32_t i = 0; i < sides; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / sides;
        for (const float z : {-halfWidth, halfWidth})
            mesh.positions.emplace_back(corner * std::cos(angle), corner * std::sin(angle), z);
        const std::uint32_t back = 2 * i, front = back + 1, nextBack = 2 * ((i + 1) % sides), nextFront = nextBack + 1;
        mesh.indices.insert(mesh.indices.end(), {back, nextBack, nextFront, back, nextFront, front});
        if (i == 0 || i + 1 == sides) continue;
        mesh.indices.insert(mesh.indices.end(), {1, front, nextFront, 0, nextBack, back});
    }
    return mesh;
}

}  // namespace

std::vector<scene::Mesh> partsOf(const scene::Mesh& mesh) {
    const std::size_t triangles = mesh.indices.size() / 3;
    Groups groups(triangles);
    std::map<std::array<float, 3>, std::size_t> firstAt;
    for (std::size_t t = 0; t < triangles; ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3& p = mesh.positions[mesh.indices[3 * t + k]];
            groups.join(t, firstAt.try_emplace({p.x, p.y, p.z}, t).first->second);
        }
    // Repeat until no two boxes overlap: a box that has grown may overlap more.
    for (bool joined = true; joined;) {
        joined = false;
        std::map<std::size_t, AxisBox> boxes;
        for (std::size_t t = 0; t < triangles; ++t) {
            AxisBox& box = boxes[groups.of(t)];
            for (std::size_t k = 0; k < 3; ++k) box.take(mesh.positions[mesh.indices[3 * t + k]]);
        }
        for (auto a = boxes.begin(); a != boxes.end(); ++a)
            for (auto b = std::next(a); b != boxes.end(); ++b)
                if (a->second.meets(b->second)) joined = groups.join(a->first, b->first) || joined;
    }

    std::map<std::size_t, scene::Mesh> parts;
    const bool coloured = mesh.colours.size() == mesh.positions.size();
    for (std::size_t t = 0; t < triangles; ++t) {
        scene::Mesh& part = parts[groups.of(t)];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.indices[3 * t + k];
            part.indices.push_back(static_cast<std::uint32_t>(part.positions.size()));
            part.positions.push_back(mesh.positions[vertex]);
            if (coloured) part.colours.push_back(mesh.colours[vertex]);
        }
    }
    std::vector<scene::Mesh> list;
    list.reserve(parts.size());
    for (auto& [first, part] : parts) list.push_back(std::move(part));
    return list;
}

Nearness::Nearness(const scene::Mesh& mesh, float cellMetres, float reachMetres) {
    MarkedVoxels solid = surfaceOf(mesh, cellMetres);
    const std::vector<std::uint8_t> onSurface = solid.marked;
    (void)markInside(solid);  // a mesh that encloses nothing keeps only its surface
    const float edge = solid.lattice.edgeMetres;
    const float reach = reachMetres / edge + std::sqrt(3.0f) / 2;  // in cells, from centre to centre
    const int rim = static_cast<int>(std::ceil(reach));
    lattice_ = {solid.lattice.counts + 2 * rim, solid.lattice.origin - edge * static_cast<float>(rim), edge};
    near_.assign(lattice_.size(), 0);
    std::vector<glm::ivec3> ball;
    for (int z = -rim; z <= rim; ++z)
        for (int y = -rim; y <= rim; ++y)
            for (int x = -rim; x <= rim; ++x)
                if (glm::length(glm::vec3(x, y, z)) <= reach) ball.emplace_back(x, y, z);
    for (std::uint32_t i = 0; i < solid.marked.size(); ++i) {
        if (!solid.marked[i]) continue;
        const glm::ivec3 cell = solid.lattice.cell(i) + rim;
        near_[lattice_.index(cell)] = 1;
        if (!onSurface[i]) continue;
        for (const glm::ivec3& step : ball) near_[lattice_.index(cell + step)] = 1;
    }
}

Nearness SolidPlaces::cellsAround(const scene::Mesh& mesh, float scale) const {
    return Nearness(mesh, cellMetres_ / scale, reachMetres_ / scale);
}

void SolidPlaces::add(const scene::Mesh& mesh, float scale, const Carrier& carrier) {
    const std::vector<scene::Mesh> parts = partsOf(mesh);
    const std::size_t first = places_.size();
    places_.resize(first + parts.size(), Place{carrier});
    parallel::forEachBlock(parts.size(), 1, [&](std::size_t i, std::size_t) {
        Place& place = places_[first + i];
        place.nearness = cellsAround(parts[i], scale);
        place.local.take(place.nearness->lattice().origin);
        place.local.take(place.nearness->lattice().maximumCorner());
    });
}

SolidPlaces::SolidPlaces(const scene::Scene& scene, float voxelMetres, const Collidable& with)
    : cellMetres_(voxelMetres / 2), reachMetres_(voxelMetres * std::sqrt(3.0f) / 2) {
    for (std::size_t i = 0; with.solids && i < scene.solids.size(); ++i) {
        const scene::Solid& solid = scene.solids[i];
        if (solid.motion == scene::SolidMotion::deforms) {
            places_.push_back({{Carrier::Kind::solid, i}});
            continue;
        }
        const bool moves = solid.motion == scene::SolidMotion::moves;
        add(*solid.mesh, scaleOf(scene.solidPoses[i].toWorld),
            {moves ? Carrier::Kind::solid : Carrier::Kind::still, i});
    }
    if (!with.vehicle || !scene.vehicle) return;
    if (scene.vehicle->body.mesh) add(*scene.vehicle->body.mesh, 1, {Carrier::Kind::body, 0});
    const scene::VehicleParameters& numbers = scene.vehicle->parameters;
    const scene::Mesh wheel =
        wheelOutline(static_cast<float>(numbers.wheelRadiusMetres), static_cast<float>(numbers.wheelWidthMetres / 2));
    for (std::size_t i = 0; i < 4; ++i) add(wheel, 1, {Carrier::Kind::wheel, i});
}

void SolidPlaces::Place::placeCells() {
    if (!nearness) return;
    const Lattice& lattice = nearness->lattice();
    const glm::mat4 toSolid = glm::inverse(*toWorld);
    toCells = glm::mat3(toSolid) / lattice.edgeMetres;
    offset = (glm::vec3(toSolid[3]) - lattice.origin) / lattice.edgeMetres;
}

void SolidPlaces::Place::moveTo(const scene::SolidPose& pose, double stepSeconds) {
    const glm::mat4 next = pose.toWorld;
    glm::mat4 before = toWorld.value_or(next);
    if (!toWorld) before[3] -= glm::vec4(static_cast<float>(stepSeconds) * pose.velocity, 0);
    toWorld = next;
    box = swept = AxisBox();
    movedMetres = 0;
    local.forEachCorner([&](const glm::vec3& corner) {
        const glm::vec3 from(before * glm::vec4(corner, 1)), to(next * glm::vec4(corner, 1));
        box.take(to);
        swept.take(from);
        swept.take(to);
        movedMetres = std::max(movedMetres, glm::distance(from, to));
    });
    placeCells();
}

void SolidPlaces::Place::deformTo(const std::shared_ptr<const scene::DeformedMesh>& next, float reachMetres) {
    if (shape != next) nearness.reset();
    // `local` covers the shapes at both ends of the step.
    AxisBox both;
    for (const auto& each : {shape, next})
        for (std::size_t v = 0; each && v < each->mesh.positions.size(); ++v) both.take(each->mesh.positions[v]);
    local.minimum = both.minimum - reachMetres;
    local.maximum = both.maximum + reachMetres;
    shape = next;
}

void SolidPlaces::moveTo(const scene::Scene& scene, const scene::SceneState& state, double stepSeconds) {
    std::optional<scene::VehiclePoses> vehicle;
    if (scene.vehicle) vehicle = scene::vehiclePoses(*scene.vehicle, state.vehicle);
    for (Place& place : places_) {
        const std::size_t number = place.carrier.number;
        switch (place.carrier.kind) {
            case Carrier::Kind::still:
                if (!place.toWorld) place.moveTo(scene.solidPoses[number], stepSeconds);
                break;
            case Carrier::Kind::solid: {
                const scene::SolidPose& pose = scene::solidPose(scene, state, number);
                if (scene.solids[number].motion == scene::SolidMotion::deforms)
                    place.deformTo(state.solids.at(number).shape, reachMetres_ / scaleOf(pose.toWorld));
                place.moveTo(pose, stepSeconds);
                break;
            }
            case Carrier::Kind::body:
                place.moveTo(vehicle->body, stepSeconds);
                break;
            case Carrier::Kind::wheel:
                place.moveTo(vehicle->wheels[number], stepSeconds);
                break;
        }
    }
}

void SolidPlaces::refresh(const AxisBox& box) {
    for (Place& place : places_) {
        if (place.nearness || !place.shape || !place.box.meets(box)) continue;
        place.nearness = cellsAround(place.shape->mesh, scaleOf(*place.toWorld));
        place.placeCells();
    }
}

std::vector<std::uint32_t> SolidPlaces::meeting(const AxisBox& box, bool anyTime) const {
    std::vector<std::uint32_t> list;
    for (std::uint32_t i = 0; i < places_.size(); ++i)
        if ((anyTime ? places_[i].swept : places_[i].box).meets(box)) list.push_back(i);
    return list;
}

bool SolidPlaces::nearAny(std::span<const std::uint32_t> places, const glm::vec3& point) const {
    return std::ranges::any_of(places, [&](std::uint32_t i) {
        const Place& place = places_[i];
        return place.nearness && place.nearness->at(place.toCells * point + place.offset);
    });
}

bool SolidPlaces::mayHit(std::span<const std::uint32_t> places, const glm::vec3& point, float lengthMetres) const {
    // Relative to the part, a path that is shorter than the reach and ends away from the part does not cross it.
    return std::ranges::any_of(places, [&](std::uint32_t i) {
        const Place& place = places_[i];
        return place.shape || lengthMetres + place.movedMetres > reachMetres_ ||
               place.nearness->at(place.toCells * point + place.offset);
    });
}

std::size_t SolidPlaces::bytes() const {
    std::size_t bytes = places_.capacity() * sizeof(Place);
    for (const Place& place : places_) bytes += place.nearness ? place.nearness->bytes() : 0;
    return bytes;
}

}  // namespace dustbench::voxel_shape
