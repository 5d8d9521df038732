#include "methods/kit/particles/scene_surface.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

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

namespace {

/// Frames and boxes are computed separately; differences in rounding must not hide a contact.
constexpr float boxMarginMetres = 0.02f;

/// From the frame of a wheel that does not spin: rolling direction, up, axle to the right.
glm::dmat4 wheelFrame(const scene::WheelState& wheel, const glm::dvec3& bodyUp) {
    const glm::dvec3 axle = glm::normalize(glm::cross(wheel.forward, bodyUp));
    glm::dmat4 matrix(1);
    matrix[0] = glm::dvec4(wheel.forward, 0);
    matrix[1] = glm::dvec4(glm::cross(axle, wheel.forward), 0);
    matrix[2] = glm::dvec4(axle, 0);
    matrix[3] = glm::dvec4(wheel.hub, 1);
    return matrix;
}

struct CylinderHit {
    float share;
    glm::vec3 normal;
};

/// x² + y² ≤ R², |z| ≤ w, from outside: the path is inside where it is inside both, so it enters at the later one.
CylinderHit meetCylinder(const glm::vec3& from, const glm::vec3& to, float radius, float halfWidth) {
    const CylinderHit missed{Surface::none, {0, 1, 0}};
    const glm::dvec3 o(from), way = glm::dvec3(to) - o;
    const double w = static_cast<double>(halfWidth), r2 = static_cast<double>(radius) * static_cast<double>(radius);

    double entersSide = -INFINITY, leavesSide = INFINITY;
    const double a = way.x * way.x + way.y * way.y, b = o.x * way.x + o.y * way.y, c = o.x * o.x + o.y * o.y - r2;
    if (a > 0) {
        const double root = b * b - a * c;
        if (root <= 0) return missed;
        entersSide = (-b - std::sqrt(root)) / a;
        leavesSide = (-b + std::sqrt(root)) / a;
    } else if (c >= 0) {
        return missed;
    }
    double entersFace = -INFINITY, leavesFace = INFINITY;
    if (way.z != 0) {
        entersFace = ((way.z > 0 ? -w : w) - o.z) / way.z;
        leavesFace = ((way.z > 0 ? w : -w) - o.z) / way.z;
    } else if (std::abs(o.z) >= w) {
        return missed;
    }
    const double enters = std::max(entersSide, entersFace);
    if (!(enters >= 0 && enters <= 1 && enters < std::min(leavesSide, leavesFace))) return missed;
    const glm::dvec3 at = o + enters * way;
    const glm::dvec3 normal =
        entersSide >= entersFace ? glm::normalize(glm::dvec3(at.x, at.y, 0)) : glm::dvec3(0, 0, way.z > 0 ? -1 : 1);
    return {static_cast<float>(enters), glm::vec3(normal)};
}

}  // namespace

SceneSurface::~SceneSurface() = default;

void SceneSurface::Box::take(const glm::vec3& point) {
    minimum = glm::min(minimum, point);
    maximum = glm::max(maximum, point);
}

void SceneSurface::Box::take(const Box& other) {
    minimum = glm::min(minimum, other.minimum);
    maximum = glm::max(maximum, other.maximum);
}

bool SceneSurface::Box::meets(const glm::vec3& from, const glm::vec3& to) const {
    return glm::all(glm::lessThanEqual(glm::min(from, to), maximum + boxMarginMetres)) &&
           glm::all(glm::lessThanEqual(minimum - boxMarginMetres, glm::max(from, to)));
}

void SceneSurface::Carried::moveTo(const glm::dmat4& toWorld, const glm::dvec3& velocity, double stepSeconds) {
    frame.moveTo(toWorld, velocity, stepSeconds);
    swept = Box();
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 point(corner & 1 ? local.maximum.x : local.minimum.x,
                               corner & 2 ? local.maximum.y : local.minimum.y,
                               corner & 4 ? local.maximum.z : local.minimum.z, 1);
        swept.take(glm::vec3(frame.atBegin() * point));
        swept.take(glm::vec3(frame.atEnd() * point));
    }
}

SceneSurface::LocalWay SceneSurface::Carried::toLocal(const Meeting& way) const {
    const float before = way.leftSeconds + way.seconds;
    LocalWay seen{frame.toLocal(way.from, before), frame.toLocal(way.to, way.leftSeconds)};
    if (!deformation) return seen;
    seen.deforming = deformation->velocityNear(seen.from, before, glm::distance(seen.from, seen.to));
    seen.from += before * seen.deforming;
    if (way.leftSeconds > 0) seen.to += way.leftSeconds * seen.deforming;
    return seen;
}

void SceneSurface::build(const scene::Scene& scene) {
    scene_ = &scene;
    carried_.clear();
    standing_.reset();
    if (parts_.solids) addMovingSolids(scene);
    if (parts_.vehicle && scene.vehicle) addVehicle(*scene.vehicle);
}

void SceneSurface::buildStill(const scene::SceneState& state) {
    solids_ = meshes::TriangleTree();
    solidsBox_ = Box();
    for (std::size_t i = 0; parts_.solids && i < scene_->solids.size(); ++i) {
        if (scene_->solids[i].motion != scene::SolidMotion::still && !standing_->contains(i)) continue;
        const scene::Mesh& mesh = scene::solidMesh(*scene_, state, i);
        const glm::mat4& toWorld = scene::solidPose(*scene_, state, i).toWorld;
        solids_.add(mesh, toWorld);
        for (const glm::vec3& point : mesh.positions) solidsBox_.take(glm::vec3(toWorld * glm::vec4(point, 1)));
    }
    solids_.build();
}

void SceneSurface::addMovingSolids(const scene::Scene& scene) {
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        if (scene.solids[i].motion == scene::SolidMotion::still) continue;
        Carried& carried = carried_.emplace_back();
        carried.solid = i;
        if (scene.solids[i].motion == scene::SolidMotion::deforms) {
            carried.deformation.emplace();
            continue;
        }
        const scene::Mesh& mesh = *scene.solids[i].mesh;
        carried.rigid.add(mesh, glm::mat4(1));
        carried.rigid.build();
        for (const glm::vec3& point : mesh.positions) carried.local.take(point);
    }
}

void SceneSurface::addVehicle(const scene::VehicleModel& vehicle) {
    if (const auto& mesh = vehicle.body.mesh) {
        Carried& body = carried_.emplace_back();
        body.rigid.add(*mesh, glm::mat4(1));
        body.rigid.build();
        for (const glm::vec3& point : mesh->positions) body.local.take(point);
    }
    const scene::VehicleParameters& numbers = vehicle.parameters;
    for (std::size_t i = 0; i < 4; ++i) {
        Carried& wheel = carried_.emplace_back();
        wheel.radiusMetres = static_cast<float>(numbers.wheelRadiusMetres);
        wheel.halfWidthMetres = static_cast<float>(numbers.wheelWidthMetres / 2);
        const glm::vec3 corner(wheel.radiusMetres, wheel.radiusMetres, wheel.halfWidthMetres);
        wheel.local = {-corner, corner};
    }
}

void SceneSurface::moveSolid(Carried& carried, const Step& step) {
    const std::size_t number = *carried.solid;
    const scene::SolidPose& pose = scene::solidPose(step.scene, step.state, number);
    if (carried.deformation) {
        if (number >= step.state.solids.size() || !step.state.solids[number].shape)
            throw std::invalid_argument("SceneSurface: a deforming solid has no shape at this moment");
        carried.deformation->moveTo(step.state.solids[number].shape, step.seconds);
        carried.local = Box();
        for (const glm::vec3& point : carried.deformation->positionsAtBegin()) carried.local.take(point);
        for (const glm::vec3& point : carried.deformation->positionsAtEnd()) carried.local.take(point);
    }
    carried.moveTo(glm::dmat4(pose.toWorld), glm::dvec3(pose.velocity), step.seconds);
    carried.stands =
        carried.frame.atBegin() == carried.frame.atEnd() &&
        (!carried.deformation || carried.deformation->positionsAtBegin() == carried.deformation->positionsAtEnd());
}

void SceneSurface::moveCarried(const Step& step) {
    carriedBox_ = Box();
    const scene::VehicleState& state = step.state.vehicle;
    std::size_t number = 0;
    for (Carried& each : carried_) {
        if (each.solid) {
            moveSolid(each, step);
        } else if (each.radiusMetres > 0) {
            const scene::WheelState& wheel = state.wheels[number++];
            each.moveTo(wheelFrame(wheel, state.up), wheel.velocity, step.seconds);
            each.spin = {0, 0, -static_cast<float>(wheel.spinRate)};
        } else {
            each.moveTo(state.toWorld(), state.forward() * state.speed, step.seconds);
        }
        if (!each.stands) carriedBox_.take(each.swept);
    }
}

void SceneSurface::begin(const Step& step) {
    if (scene_ != &step.scene) build(step.scene);
    moveCarried(step);
    std::set<std::size_t> standing;
    for (const Carried& each : carried_)
        if (each.stands) standing.insert(*each.solid);
    if (standing_ != standing) {
        standing_ = std::move(standing);
        buildStill(step.state);
    }
    extentMetres_ = 0;
    if (solids_.triangles() > 0)
        extentMetres_ = std::max(sumOfSizes(solidsBox_.minimum), sumOfSizes(solidsBox_.maximum));
    if (std::ranges::any_of(carried_, [](const Carried& each) { return !each.stands; }))
        extentMetres_ = std::max({extentMetres_, sumOfSizes(carriedBox_.minimum), sumOfSizes(carriedBox_.maximum)});
}

SceneSurface::Found SceneSurface::findOn(const Carried& carried, const Meeting& way) const {
    const auto [from, to, deforming] = carried.toLocal(way);
    if (carried.radiusMetres > 0) {
        const CylinderHit hit = meetCylinder(from, to, carried.radiusMetres, carried.halfWidthMetres);
        return {hit.share, &carried, hit.normal};
    }
    const auto hit = carried.tree().firstHit(from, to);
    return hit ? Found{hit->share, &carried, hit->normal} : Found{};
}

SceneSurface::Found SceneSurface::find(const Meeting& way, float groundShare) const {
    Found first;
    if (groundShare <= 1) {
        const glm::vec3 point = way.from + groundShare * (way.to - way.from);
        first = {groundShare, nullptr, scene_->terrain.normalAt(point.x, point.z)};
    }
    if (solids_.triangles() > 0 && solidsBox_.meets(way.from, way.to))
        if (const auto hit = solids_.firstHit(way.from, way.to); hit && hit->share < first.share)
            first = {hit->share, nullptr, hit->normal};
    if (carried_.empty() || !carriedBox_.meets(way.from, way.to)) return first;
    for (const Carried& each : carried_) {
        if (each.stands || !each.swept.meets(way.from, way.to)) continue;
        if (const Found found = findOn(each, way); found.share < first.share) first = found;
    }
    return first;
}

void SceneSurface::meet(const Ways& ways, float* share) const {
    if (parts_.ground)
        meetGround(ways, scene_->terrain, share);
    else
        std::fill_n(share, ways.count, none);
    for (std::size_t i = 0; i < ways.count; ++i) {
        const glm::vec3 from = ways.from(i), to = ways.to(i);
        if (solidsBox_.meets(from, to) || carriedBox_.meets(from, to))
            share[i] = find({from, to, ways.seconds[i], none, ways.leftSeconds}, share[i]).share;
    }
}

Touch SceneSurface::touchAt(const Meeting& way) const {
    float groundShare = none;
    if (parts_.ground)
        meetGround({1, &way.from.x, &way.from.y, &way.from.z, &way.to.x, &way.to.y, &way.to.z, &way.seconds},
                   scene_->terrain, &groundShare);
    const Found found = find(way, groundShare);
    if (!found.carried) return {way.point(), found.normal};
    const CarriedFrame& frame = found.carried->frame;
    const LocalWay localWay = found.carried->toLocal(way);
    const glm::vec3 local = localWay.at(way.share);
    const float left = way.leftSeconds + way.seconds * (1 - way.share);
    const glm::vec3 turning = glm::cross(found.carried->spin, local);
    const glm::vec3 ofFrame =
        frame.velocityOf(local) +
        (turning == glm::vec3(0) ? turning : glm::length(turning) * frame.directionToWorld(turning, left));
    if (!found.carried->deformation)
        return {frame.toWorld(local, left), frame.directionToWorld(found.normal, left), ofFrame};
    // The point is that at the step's end; by the contact, the deformation had moved the surface only part of the way.
    const glm::vec3 deforming = found.carried->deformation->velocityOfPointAtEnd(local);
    return {frame.toWorld(local - left * deforming, left), frame.directionToWorld(found.normal, left),
            ofFrame + glm::mat3(glm::mat4(frame.atEnd())) * deforming};
}

std::size_t SceneSurface::bytes() const {
    std::size_t bytes = solids_.bytes();
    for (const Carried& each : carried_)
        if (each.radiusMetres == 0) bytes += each.deformation ? each.deformation->bytes() : each.rigid.bytes();
    return bytes;
}

}  // namespace dustbench::particles
