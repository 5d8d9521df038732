#include "methods/voxel_shape/living_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>

#include "methods/voxel_shape/particles/draw_along.h"
#include "methods/voxel_shape/shape_builder.h"

namespace dustbench::voxel_shape {
namespace {

/// Returns the rotation from one orientation to another as a vector: axis times angle.
glm::dvec3 turnBetween(const glm::dmat3& from, const glm::dmat3& to) {
    glm::dquat turn = glm::quat_cast(to * glm::transpose(from));
    if (turn.w < 0) turn = -turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    return sine > 0 ? axis / sine * (2 * std::atan2(sine, turn.w)) : glm::dvec3(0);
}

}  // namespace

TrackMoment momentAt(const Track& track, double timeSeconds) {
    const auto& keys = track.keys;
    const double length = keys.back().timeSeconds;
    if (!(length > 0)) return {keys.front(), {0, glm::dvec3(0), 0, 0}};
    const double time = timeSeconds - std::floor(timeSeconds / length) * length;
    std::size_t next = 1;
    while (next + 1 < keys.size() && keys[next].timeSeconds < time) ++next;
    const TrackKey &from = keys[next - 1], &to = keys[next];
    const double seconds = to.timeSeconds - from.timeSeconds, share = (time - from.timeSeconds) / seconds;
    return {{time, glm::mix(from.position, to.position, share), glm::mix(from.heading, to.heading, share),
             glm::mix(from.scale, to.scale, share)},
            {1, (to.position - from.position) / seconds, (to.heading - from.heading) / seconds,
             (to.scale - from.scale) / seconds}};
}

Pose ShapeTrack::advance(const scene::SceneState& state, double stepSeconds) {
    // The frame of the track: its pose and how it moves and turns.
    const glm::dmat4 frame = track_.followsVehicle ? state.vehicle.toWorld() : glm::dmat4(1);
    const glm::dmat3 turned(frame);
    const glm::dvec3 velocity = track_.followsVehicle ? state.vehicle.speed * state.vehicle.forward() : glm::dvec3(0);
    const glm::dvec3 spin = lastFrame_ ? turnBetween(*lastFrame_, turned) / stepSeconds : glm::dvec3(0);
    lastFrame_ = turned;

    const auto [key, rate] = momentAt(track_, state.timeSeconds);
    const glm::dvec3 place = turned * key.position;
    Pose pose;
    pose.rotation = glm::mat3(turned * glm::dmat3(glm::rotate(glm::dmat4(1), key.heading, {0, 1, 0})));
    pose.position = glm::vec3(glm::dvec3(frame[3]) + place);
    pose.scale = static_cast<float>(key.scale);
    pose.velocity = glm::vec3(velocity + glm::cross(spin, place) + turned * rate.position);
    pose.angularVelocity = glm::vec3(spin + turned * glm::dvec3(0, rate.heading, 0));
    pose.growth = static_cast<float>(rate.scale / key.scale);
    return pose;
}

void LivingShape::prepare(MemoryLedger& ledger, const scene::Scene& scene, gpu::Device& device, std::uint64_t seed) {
    system_.emplace(buildShape(ledger, shape_, scene, device, seed));
    if (shape_.look.lit || scene.lights.onDust) light_.emplace(ledger, system_->grid(), scene.lights);
    if (shape_.stress.fullMetres > 0) stress_.emplace(ledger, *system_, shape_.stress);
    if (shape_.dustDrawsPerSecond > 0) flow_.emplace(ledger);
    if (!shape_.flow.files.empty()) field_.emplace(shape_.flow.files, shape_.flow.field);
    if (shape_.flow.massLoading > 0) wake_.emplace(ledger, shape_.flow.massLoading, shape_.flow.wakeSeconds);
    const Collidable& with = shape_.collidesWith;
    if ((with.solids && !scene.solids.empty()) || (with.vehicle && scene.vehicle)) {
        double scale = 0;
        for (const TrackKey& key : shape_.track.keys) scale = std::max(scale, key.scale);
        const float voxel = system_->grid().lattice().edgeMetres * static_cast<float>(scale);
        collision_ = std::make_unique<ShapeCollision>(scene, voxel, shape_.impact, with);
    }
    shape_.motion.wind = shape_.windFactor * scene.wind;
}

void LivingShape::step(const Frame& frame) {
    const Pose pose = track_.advance(frame.state, frame.stepSeconds);
    const auto seconds = static_cast<float>(frame.stepSeconds);
    {
        const auto timing = frame.clock.measureDetail("move");
        system_->live(shape_.motion, seconds);
    }
    if (collision_) {
        const auto timing = frame.clock.measureDetail("collide");
        collision_->moveTo(frame.state, frame.stepSeconds);
        collision_->stopParticles(system_->particles(), seconds);
    }
    // Switch voxels for the new pose before `replace`, so that nothing is born inside a solid.
    if (collision_) {
        const auto timing = frame.clock.measureDetail("switch voxels");
        collision_->switchVoxels(system_->grid(), pose);
    }
    if (light_) {
        const auto timing = frame.clock.measureDetail("light");
        light_->shineOn(system_->grid(), pose);
    }
    {
        const auto timing = frame.clock.measureDetail("replace");
        system_->replace(pose, shape_.motion, seconds);
    }
    if (stress_) {
        const auto timing = frame.clock.measureDetail("stress");
        stress_->showOn(*system_);
    }
    if (flow_) {
        const auto timing = frame.clock.measureDetail("flow");
        flow_->drawAlong(*system_, frame.dust, 1 - std::exp(-shape_.dustDrawsPerSecond * seconds));
    }
    if (field_) {
        const auto timing = frame.clock.measureDetail("flow");
        const double since = shape_.flow.fromSeconds ? *shape_.flow.fromSeconds - field_->firstSeconds() : 0;
        const double time = frame.state.timeSeconds - since;
        const Flow flow = shape_.flow.followsShape ? flowOf(*field_, pose, time) : flowOf(*field_, time);
        if (wake_) {
            wake_->exchange(*system_, flow, shape_.flow.drawsPerSecond, seconds);
            wake_->carry(*system_, flow, seconds);
        } else {
            drawAlong(system_->particles().store, flow, 1 - std::exp(-shape_.flow.drawsPerSecond * seconds));
        }
    }
}

void LivingShape::requireNumberHeld() const {
    if (!(shape_.heldWithin > 0)) return;
    const ShapeCount count = system_->count();
    const auto held = static_cast<double>(count.inside), room = static_cast<double>(count.room);
    if (std::abs(held - room) <= shape_.heldWithin * room) return;
    throw std::runtime_error(fmt::format("shape '{}': its voxels hold {} particles, allowed: {} within {} %",
                                         shape_.name, count.inside, count.room, 100 * shape_.heldWithin));
}

MemoryReport LivingShape::memory() const {
    MemoryReport report = collision_ ? collision_->memory() : MemoryReport();
    if (field_) report.push_back({"flow", field_->bytes(), 0});
    return report;
}

}  // namespace dustbench::voxel_shape
