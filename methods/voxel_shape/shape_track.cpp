#include "methods/voxel_shape/shape_track.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace dustbench::voxel_shape {

TrackKey keyAt(const Track& track, double timeSeconds) {
    const auto& keys = track.keys;
    const double length = keys.back().timeSeconds;
    if (!(length > 0)) return keys.front();
    const double time = timeSeconds - std::floor(timeSeconds / length) * length;
    std::size_t next = 1;
    while (next + 1 < keys.size() && keys[next].timeSeconds < time) ++next;
    const TrackKey &from = keys[next - 1], &to = keys[next];
    const double share = (time - from.timeSeconds) / (to.timeSeconds - from.timeSeconds);
    return {time, glm::mix(from.position, to.position, share), glm::mix(from.heading, to.heading, share),
            glm::mix(from.scale, to.scale, share)};
}

Pose ShapeTrack::advance(const scene::SceneState& state, double stepSeconds) {
    const TrackKey key = keyAt(track_, state.timeSeconds);
    glm::dmat4 matrix = track_.followsVehicle ? state.vehicle.toWorld() : glm::dmat4(1);
    matrix = glm::rotate(glm::translate(matrix, key.position), key.heading, {0, 1, 0});
    Pose pose;
    pose.rotation = glm::mat3(matrix);
    pose.position = glm::vec3(matrix[3]);
    pose.scale = static_cast<float>(key.scale);
    if (last_) {
        const auto perSecond = static_cast<float>(1 / stepSeconds);
        pose.velocity = (pose.position - last_->position) * perSecond;
        // The turn from the last pose to this one, as a vector: axis times angle.
        glm::quat turn = glm::quat_cast(pose.rotation * glm::transpose(last_->rotation));
        if (turn.w < 0) turn = -turn;
        const glm::vec3 axis(turn.x, turn.y, turn.z);
        const float sine = glm::length(axis);
        if (sine > 0) pose.angularVelocity = axis / sine * (2 * std::atan2(sine, turn.w) * perSecond);
        pose.growth = std::log(pose.scale / last_->scale) * perSecond;
    }
    last_ = pose;
    return pose;
}

}  // namespace dustbench::voxel_shape
