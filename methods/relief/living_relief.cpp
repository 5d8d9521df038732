#include "methods/relief/living_relief.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/meshes/curved_panel.h"

namespace dustbench::relief {
namespace {

constexpr float marginMetres = 1e-3f;  // floats of a kilometre are exact to 6e-5 m; the exact test follows

/// The signed distance of a point from the plane z = 0 of a pose.
struct FacePlane {
    explicit FacePlane(const glm::dmat4& pose)
        : normal(pose[2]), offset(static_cast<float>(glm::dot(glm::dvec3(pose[2]), glm::dvec3(pose[3])))) {}

    [[nodiscard]] float distance(float x, float y, float z) const {
        return normal.x * x + normal.y * y + normal.z * z - offset;
    }

    glm::vec3 normal;
    float offset;
};

/// The part of the way from `from` to `to` within a box, as shares of it; empty (first > last) if there is none.
struct Within {
    double first = 0, last = 1;
};
Within within(const meshes::PlateBounds& box, const glm::dvec3& from, const glm::dvec3& to) {
    Within part;
    for (int axis = 0; axis < 3; ++axis) {
        const double way = to[axis] - from[axis];
        if (way == 0 && (from[axis] < box.low[axis] || from[axis] > box.high[axis])) return {1, 0};
        if (way == 0) continue;
        const double a = (box.low[axis] - from[axis]) / way, b = (box.high[axis] - from[axis]) / way;
        part.first = std::max(part.first, std::min(a, b));
        part.last = std::min(part.last, std::max(a, b));
    }
    return part;
}

/// The place where a straight way in the panel's frame passes a curved face from outside, in the frame of the relief.
std::optional<glm::dvec3> entryThroughCurve(const scene::Panel& panel, const glm::dvec3& from, const glm::dvec3& to) {
    const Within part = within(meshes::boundsOf(panel), from, to);
    if (part.first > part.last) return std::nullopt;
    const auto reliefAt = [&](double share) { return meshes::toRelief(panel, glm::mix(from, to, share)); };
    double outside = part.first, inside = part.last;
    // Where the box touches the face, rounding may put either end on the wrong side.
    if (!(reliefAt(outside).z > -1e-9 && reliefAt(inside).z <= 0)) return std::nullopt;
    for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (outside + inside);
        (reliefAt(middle).z > 0 ? outside : inside) = middle;
    }
    return reliefAt(inside);
}

ReliefStyle with(ReliefStyle style, bool carShadow, bool dustShadow) {
    style.carShadow = carShadow;
    style.dustShadow = dustShadow;
    return style;
}

}  // namespace

LivingRelief::LivingRelief(const scene::Scene& scene, const scene::Panel& panel, const ReliefSettings& settings,
                           gpu::Device& device, MemoryLedger& ledger)
    : panel_(panel),
      settings_(settings),
      takesCarShadow_(settings.style.shadow && scene.vehicle && panel.parent == scene::Panel::Parent::world),
      surface_(*panel.relief, ledger),
      pyramid_(surface_.depths(), ledger),
      particles_(panel, ledger),
      picture_(device, scene, panel, pyramid_, with(settings.style, takesCarShadow_, scene.lights.onDust)) {
    if (settings.state == StateIn::texture && meshes::isCurved(panel))
        throw InputError("parameter state: got texture with the curved panel '" + panel.name +
                         "', allowed: array, or panels without curvature_per_metre");
    if (settings.state == StateIn::texture)
        textures_ = std::make_unique<TextureMover>(device, panel, surface_.depths());
}

void LivingRelief::create(const Frame& frame, SerialSet& taken) {
    toWorld_ = scene::panelToWorld(panel_, frame.state);
    const glm::dmat4 before = toWorldBefore_.value_or(toWorld_);
    toWorldBefore_ = toWorld_;
    frame_ = PanelFrame(before, toWorld_, frame.stepSeconds);

    const FacePlane planeBefore(before), planeNow(toWorld_);
    const meshes::PlateBounds plate = meshes::boundsOf(panel_);
    const auto highest = static_cast<float>(plate.high.z),
               lowest = static_cast<float>(plate.low.z + panel_.depthMetres);
    const Puffs& dust = frame.dust;
    const auto dt = static_cast<float>(frame.stepSeconds);
    for (std::size_t i = 0; i < dust.x.size(); ++i) {
        if (planeNow.distance(dust.x[i], dust.y[i], dust.z[i]) > highest + marginMetres) continue;
        const float earlier = planeBefore.distance(
            dust.x[i] - dust.velocityX[i] * dt, dust.y[i] - dust.velocityY[i] * dt, dust.z[i] - dust.velocityZ[i] * dt);
        if (earlier > lowest - marginMetres) enter(dust, i, frame.stepSeconds, taken);
    }
}

/// Where a way in the panel's frame passes the face from outside, in the frame of the relief.
std::optional<glm::dvec3> LivingRelief::entryOf(const glm::dvec3& from, const glm::dvec3& to) const {
    if (meshes::isCurved(panel_)) return entryThroughCurve(panel_, from, to);
    if (!(from.z > 0 && to.z <= 0)) return std::nullopt;
    return glm::mix(from, to, from.z / (from.z - to.z));
}

Moving LivingRelief::inWorld(std::size_t particle) const {
    const glm::dvec3 place(particles_.places()[particle]), velocity(particles_.velocities()[particle]);
    return frame_.toWorld({meshes::fromRelief(panel_, place), meshes::reliefAxes(panel_, place) * velocity});
}

glm::dvec3 LivingRelief::placeInWorld(const glm::dvec3& relief) const {
    return glm::dvec3(toWorld_ * glm::dvec4(meshes::fromRelief(panel_, relief), 1));
}

void LivingRelief::enter(const Puffs& dust, std::size_t i, double stepSeconds, SerialSet& taken) {
    const glm::dvec3 velocity(dust.velocityX[i], dust.velocityY[i], dust.velocityZ[i]);
    const glm::dvec3 place(dust.x[i], dust.y[i], dust.z[i]);
    const glm::dvec3 from = frame_.toPanelBefore(place - velocity * stepSeconds);
    const Moving now = frame_.toPanel({place, velocity});
    if (taken.contains(dust.serial[i])) return;
    const std::optional<glm::dvec3> entry = entryOf(from, now.place);
    if (!entry || std::abs(entry->x) > panel_.sizeMetres.x / 2 || std::abs(entry->y) > panel_.sizeMetres.y / 2) return;
    const glm::dvec3 within(entry->x, entry->y, 0);
    const glm::dvec3 velocityWithin = glm::inverse(meshes::reliefAxes(panel_, within)) * now.velocity;
    particles_.add({glm::vec3(within), glm::vec3(velocityWithin)}, {dust.radius[i], dust.opacity[i]}, dust.serial[i]);
    taken.insert(dust.serial[i]);
}

void LivingRelief::move(double stepSeconds) {
    const glm::vec3 gravity(frame_.directionToPanel({0, -static_cast<double>(settings_.gravity), 0}));
    const StepSettings step{settings_.motion, gravity, static_cast<float>(stepSeconds), settings_.maximumAgeSteps,
                            &pyramid_};
    if (textures_)
        particles_.step(*textures_, surface_.depths(), step);
    else
        particles_.step(surface_.depths(), step);
}

void LivingRelief::age() {
    impacts_.clear();
    for (const SurfaceHit& hit : particles_.hits())
        impacts_.push_back(impactOf(hit, settings_.ageing, particles_.texels(), panel_.depthMetres));
    hits_ += impacts_.size();
    if (settings_.search == Search::gather)
        surface_.gather(impacts_);
    else
        surface_.scatter(impacts_);
    if (settings_.ageing.model == AgeingModel::deposit)
        surface_.layOn(reposeOf(settings_.ageing, panel_));
    else
        surface_.takeOff();
}

void LivingRelief::upload() {
    const TexelRectangle changed = surface_.takeChanged();
    pyramid_.update(surface_.depths(), changed);
    static_cast<void>(picture_.upload(surface_, pyramid_, changed));
    if (textures_) textures_->upload(surface_.depths(), changed);
}

namespace {

/// The columns of a surface as passed to a visitor: glm::vec3 and float, in world space.
struct SurfaceColumns {
    std::vector<glm::vec3> position, colour;
    std::vector<float> height, removed, laid, hits;
};

}  // namespace

void LivingRelief::handOver(VolumeVisitor& visitor) const {
    const DepthMap& map = surface_.depths();
    const auto metres = [&](std::uint32_t steps) {
        return static_cast<float>(panel_.depthMetres * steps / DepthMap::bottom);
    };
    SurfaceColumns columns;
    for (int row = 0; row < map.rows(); ++row)
        for (int column = 0; column < map.columns(); ++column) {
            const std::size_t i = map.texel(column, row);
            const glm::dvec3 place = particles_.texels().toMetres({column, row, map.at(column, row)});
            columns.position.emplace_back(placeInWorld(place));
            columns.height.push_back(static_cast<float>(1 - map.at(column, row)));
            columns.removed.push_back(metres(surface_.worn()[i]));
            columns.laid.push_back(metres(surface_.laid()[i]));
            columns.hits.push_back(static_cast<float>(surface_.hits()[i]));
            columns.colour.push_back(picture_.colourOf(surface_, i));
        }
    const std::array fields{GridField{"depth_removed", "m", 1, columns.removed},
                            GridField{"deposit", "m", 1, columns.laid}, GridField{"hits", "", 1, columns.hits}};
    visitor.surface({panel_.name, map.columns(), map.rows(), columns.position, columns.colour, columns.height, fields});
    if (!textures_) return;
    const TextureMover::StateCopy state = textures_->copyState();
    visitor.texture({panel_.name + " position", state.columns, state.rows, state.places});
    visitor.texture({panel_.name + " velocity", state.columns, state.rows, state.velocities});
}

void LivingRelief::addTo(maths::Hash& hash) const {
    for (const std::span<const std::uint32_t> column :
         {surface_.depths().depths(), surface_.hits(), surface_.worn(), surface_.laid()})
        hash.add(column);
    hash.add(particles_.places());
    hash.add(particles_.velocities());
}

}  // namespace dustbench::relief
