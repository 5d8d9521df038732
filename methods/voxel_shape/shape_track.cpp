#include "methods/voxel_shape/shape_track.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

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

}  // namespace dustbench::voxel_shape
