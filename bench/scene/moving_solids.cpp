#include "bench/scene/moving_solids.h"

#include <utility>

namespace dustbench::bench {

void MovingSolids::add(std::size_t solid, SolidPath path, double scale, std::optional<meshes::MorphMesh> morph) {
    all_.push_back({solid, std::move(path), scale, std::move(morph)});
}

std::vector<scene::SolidNow> MovingSolids::at(const scene::Scene& scene, double seconds) const {
    std::vector<scene::SolidNow> solids;
    if (all_.empty()) return solids;
    for (const scene::SolidPose& pose : scene.solidPoses) solids.push_back({pose, nullptr});
    for (const Moving& moving : all_) {
        const SolidPath::Moment moment = moving.path.at(seconds);
        scene::SolidNow& now = solids[moving.solid];
        now.pose = moment.pose(moving.scale);
        if (moving.morph)
            now.shape = std::make_shared<const scene::DeformedMesh>(
                meshes::deformed(*moving.morph, moment.weights, moment.weightsPerSecond));
    }
    return solids;
}

std::size_t MovingSolids::bytes() const {
    std::size_t bytes = 0;
    for (const Moving& moving : all_) {
        if (!moving.morph) continue;
        for (const std::vector<glm::vec3>& offsets : moving.morph->offsets) bytes += offsets.size() * sizeof(glm::vec3);
    }
    return bytes;
}

}  // namespace dustbench::bench
