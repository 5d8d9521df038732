#include "methods/voxel_shape/silhouette.h"

#include <algorithm>
#include <stdexcept>

namespace dustbench::voxel_shape {
namespace {

float cross(const glm::vec2& a, const glm::vec2& b) {
    return a.x * b.y - a.y * b.x;
}

void fillTriangle(std::vector<std::uint8_t>& mask, const scene::View& view, const glm::vec2& a, const glm::vec2& b,
                  const glm::vec2& c) {
    const glm::vec2 size(view.width, view.height);
    const glm::vec2 minimum = glm::clamp(glm::min(glm::min(a, b), c), glm::vec2(0), size);
    const glm::vec2 maximum = glm::clamp(glm::max(glm::max(a, b), c), glm::vec2(0), size - 1.0f);
    for (int y = static_cast<int>(minimum.y); y <= static_cast<int>(maximum.y); ++y)
        for (int x = static_cast<int>(minimum.x); x <= static_cast<int>(maximum.x); ++x) {
            const glm::vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const float u = cross(b - a, p - a), v = cross(c - b, p - b), w = cross(a - c, p - c);
            if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))
                mask[static_cast<std::size_t>(y * view.width + x)] = 1;
        }
}

}  // namespace

std::vector<std::uint8_t> silhouetteOf(const scene::Mesh& mesh, const Pose& pose, const scene::View& view) {
    std::vector<std::uint8_t> mask(static_cast<std::size_t>(view.width * view.height), 0);
    const glm::mat4 clip = view.worldToClip();
    const auto nearest = static_cast<float>(view.camera.nearMetres);
    std::vector<glm::vec3> points;  // x, y in pixels, and the distance along the axis
    points.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions) {
        const glm::vec4 p = clip * glm::vec4(pose.toWorld(position), 1);
        points.emplace_back((0.5f + 0.5f * p.x / p.w) * static_cast<float>(view.width),
                            (0.5f - 0.5f * p.y / p.w) * static_cast<float>(view.height), p.w);
    }
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const glm::vec3 &a = points[mesh.indices[t]], &b = points[mesh.indices[t + 1]],
                        &c = points[mesh.indices[t + 2]];
        if (std::min({a.z, b.z, c.z}) > nearest) fillTriangle(mask, view, glm::vec2(a), glm::vec2(b), glm::vec2(c));
    }
    return mask;
}

std::optional<double> overlapOf(const std::vector<std::uint8_t>& mask, const pictures::Image& layer) {
    if (mask.size() != layer.pixels.size()) throw std::invalid_argument("overlapOf: mask and layer differ in size");
    std::int64_t both = 0, either = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        const bool drawn = layer.pixels[i].a > 0.5f, meant = mask[i] != 0;
        both += drawn && meant;
        either += drawn || meant;
    }
    return either > 0 ? std::optional(static_cast<double>(both) / static_cast<double>(either)) : std::nullopt;
}

}  // namespace dustbench::voxel_shape
