#include "bench/world/surface_builder.h"

#include <cmath>
#include <numbers>

namespace dustbench::world {
namespace {

/// ∂P/∂u × ∂P/∂v, by differences within the range of the lines.
glm::vec3 smoothNormal(const SurfaceBuilder::Position& position, std::span<const float> us, std::span<const float> vs,
                       float u, float v) {
    const float du = 0.01f * (us.back() - us.front()), dv = 0.01f * (vs.back() - vs.front());
    const auto within = [](float x, std::span<const float> range) {
        return std::clamp(x, std::min(range.front(), range.back()), std::max(range.front(), range.back()));
    };
    const glm::vec3 alongU = position(within(u + du, us), v) - position(within(u - du, us), v);
    const glm::vec3 alongV = position(u, within(v + dv, vs)) - position(u, within(v - dv, vs));
    const glm::vec3 normal = glm::cross(alongU, alongV);
    const float length = glm::length(normal);
    return length > 0 ? normal / length : glm::vec3(0, 1, 0);
}

}  // namespace

std::vector<float> lines(float first, float last, int cells) {
    std::vector<float> values;
    for (int i = 0; i <= cells; ++i)
        values.push_back(first + (last - first) * static_cast<float>(i) / static_cast<float>(cells));
    return values;
}

void SurfaceBuilder::quad(const glm::vec3 (&corners)[4], const glm::vec3 (&normals)[4], const glm::vec3& colour) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (int i = 0; i < 4; ++i) {
        mesh_.positions.push_back(corners[i]);
        mesh_.normals.push_back(normals[i]);
        mesh_.colours.push_back(colour);
    }
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::vec3 area = glm::cross(corners[b] - corners[a], corners[c] - corners[a]);
        if (glm::dot(area, area) < 1e-16f) return;  // a quad that degenerates to a triangle
        mesh_.indices.insert(mesh_.indices.end(), {first + a, first + b, first + c});
    };
    triangle(0, 1, 2);
    triangle(0, 2, 3);
}

void SurfaceBuilder::patch(std::span<const float> us, std::span<const float> vs, const Position& position,
                           const Position& normal, const Colour& colour) {
    for (std::size_t i = 0; i + 1 < us.size(); ++i)
        for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
            const float u[4] = {us[i], us[i + 1], us[i + 1], us[i]};
            const float v[4] = {vs[j], vs[j], vs[j + 1], vs[j + 1]};
            glm::vec3 corners[4], normals[4];
            for (int k = 0; k < 4; ++k) {
                corners[k] = position(u[k], v[k]);
                normals[k] = normal(u[k], v[k]);
            }
            quad(corners, normals, colour((us[i] + us[i + 1]) / 2, (vs[j] + vs[j + 1]) / 2));
        }
}

void SurfaceBuilder::patch(std::span<const float> us, std::span<const float> vs, const Position& position,
                           const Colour& colour) {
    patch(
        us, vs, position, [&](float u, float v) { return smoothNormal(position, us, vs, u, v); }, colour);
}

void SurfaceBuilder::facets(std::span<const float> us, std::span<const float> vs, const Position& position,
                            const Colour& colour) {
    for (std::size_t i = 0; i + 1 < us.size(); ++i)
        for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
            const glm::vec3 corners[4] = {position(us[i], vs[j]), position(us[i + 1], vs[j]),
                                          position(us[i + 1], vs[j + 1]), position(us[i], vs[j + 1])};
            const glm::vec3 normal = glm::cross(corners[2] - corners[0], corners[3] - corners[1]);
            if (glm::length(normal) < 1e-9f) continue;
            const glm::vec3 unit = glm::normalize(normal);
            quad(corners, {unit, unit, unit, unit}, colour((us[i] + us[i + 1]) / 2, (vs[j] + vs[j + 1]) / 2));
        }
}

void SurfaceBuilder::box(const glm::vec3& centre, const glm::vec3& half, const glm::vec3& colour) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 normal(0), first(0), second(0);
            normal[axis] = side;
            first[(axis + 1) % 3] = half[(axis + 1) % 3];
            second[(axis + 2) % 3] = half[(axis + 2) % 3] * side;  // keeps first × second along the normal
            const glm::vec3 middle = centre + normal * half;
            quad({middle - first - second, middle + first - second, middle + first + second, middle - first + second},
                 {normal, normal, normal, normal}, colour);
        }
}

void SurfaceBuilder::turned(std::span<const glm::vec2> profile, int segments,
                            const std::function<glm::vec3(int part, int segment)>& colour) {
    const float whole = 2 * std::numbers::pi_v<float>;
    for (std::size_t part = 0; part + 1 < profile.size(); ++part) {
        const glm::vec2 along = profile[part + 1] - profile[part];
        const glm::vec2 across = glm::normalize(glm::vec2(-along.y, along.x));
        for (int segment = 0; segment < segments; ++segment) {
            glm::vec3 corners[4], normals[4];
            for (int k = 0; k < 4; ++k) {
                const float angle =
                    whole * static_cast<float>(segment + (k == 1 || k == 2)) / static_cast<float>(segments);
                const glm::vec2 point = profile[part + (k >= 2)];
                corners[k] = {point.x * std::cos(angle), point.x * std::sin(angle), point.y};
                normals[k] = {across.x * std::cos(angle), across.x * std::sin(angle), across.y};
            }
            // With the radius increasing and the outside towards +z, the angle must run in the opposite direction.
            quad({corners[0], corners[3], corners[2], corners[1]}, {normals[0], normals[3], normals[2], normals[1]},
                 colour(static_cast<int>(part), segment));
        }
    }
}

void SurfaceBuilder::lamp(const glm::vec3& centre, float radius, float depth, bool forwards, const glm::vec3& glass,
                          const glm::vec3& rim) {
    SurfaceBuilder part;
    const glm::vec2 profile[] = {{radius, -depth}, {radius, 0}, {0.82f * radius, 0.15f * radius}, {0, 0.15f * radius}};
    // The profile runs upwards and inwards, so its left is the inside: reverse it.
    const glm::vec2 outward[] = {profile[3], profile[2], profile[1], profile[0]};
    part.turned(outward, 14, [&](int k, int) { return k == 0 ? glass : rim; });
    glm::mat4 turn(0);  // z → ±x
    const float side = forwards ? 1.0f : -1.0f;
    turn[0] = {0, 0, -side, 0};
    turn[1] = {0, 1, 0, 0};
    turn[2] = {side, 0, 0, 0};
    turn[3] = glm::vec4(centre, 1);
    mesh_.append(part.finish(), turn);
}

void SurfaceBuilder::mirror(std::size_t firstVertex, std::size_t firstIndex) {
    const std::size_t lastVertex = mesh_.positions.size(), lastIndex = mesh_.indices.size();
    const glm::vec3 flip(1, 1, -1);
    for (std::size_t i = firstVertex; i < lastVertex; ++i) {
        mesh_.positions.push_back(mesh_.positions[i] * flip);
        mesh_.normals.push_back(mesh_.normals[i] * flip);
        mesh_.colours.push_back(glm::vec3(mesh_.colours[i]));
    }
    const auto shift = static_cast<std::uint32_t>(lastVertex - firstVertex);
    for (std::size_t i = firstIndex; i < lastIndex; i += 3)
        for (const std::size_t corner : {i, i + 2, i + 1})
            mesh_.indices.push_back(std::uint32_t{mesh_.indices[corner] + shift});
}

}  // namespace dustbench::world
