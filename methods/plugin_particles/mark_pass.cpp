#include "methods/plugin_particles/mark_pass.h"

#include <algorithm>
#include <numbers>

namespace dustbench::plugin_particles {
namespace {

void addPoint(scene::Mesh& mesh, const glm::vec3& position, const glm::vec3& normal) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.colours.emplace_back(1);
}

/// The first corner and every two neighbours after it.
void addFan(scene::Mesh& mesh, std::initializer_list<std::uint32_t> corners) {
    const std::uint32_t* c = corners.begin();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        for (const std::uint32_t corner : {c[0], c[k], c[k + 1]}) mesh.indices.push_back(corner);
}

/// Of radius 1, across the x axis.
scene::Mesh discMesh() {
    constexpr std::uint32_t corners = 64;
    scene::Mesh mesh;
    addPoint(mesh, glm::vec3(0), {1, 0, 0});
    for (std::uint32_t k = 0; k < corners; ++k) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / corners;
        addPoint(mesh, {0, std::cos(angle), std::sin(angle)}, {1, 0, 0});
        addFan(mesh, {0, k + 1, (k + 1) % corners + 1});
    }
    return mesh;
}

/// Of radius 1, in degrees of longitude and latitude.
scene::Mesh ballMesh() {
    constexpr std::uint32_t rings = 24, corners = 48;
    scene::Mesh mesh;
    for (std::uint32_t ring = 0; ring <= rings; ++ring)
        for (std::uint32_t k = 0; k < corners; ++k) {
            const float down = std::numbers::pi_v<float> * static_cast<float>(ring) / rings;
            const float around = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / corners;
            const glm::vec3 p(std::sin(down) * std::cos(around), std::cos(down), std::sin(down) * std::sin(around));
            addPoint(mesh, p, p);
            if (ring == rings) continue;
            const std::uint32_t first = ring * corners + k, next = ring * corners + (k + 1) % corners;
            addFan(mesh, {first, next, next + corners, first + corners});
        }
    return mesh;
}

/// Three bars along the axes, of half length 1.
scene::Mesh crossMesh() {
    constexpr float thin = 0.25f;
    scene::Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 half(thin);
        half[axis] = 1;
        for (int face = 0; face < 6; ++face) {
            const int along = face / 2, u = (along + 1) % 3, v = (along + 2) % 3;
            glm::vec3 normal(0);
            normal[along] = face % 2 ? 1.0f : -1.0f;
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const auto& [side, up] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
                glm::vec3 corner = normal * half;
                corner[u] = static_cast<float>(side) * half[u];
                corner[v] = static_cast<float>(up) * half[v];
                addPoint(mesh, corner, normal);
            }
            addFan(mesh, {first, first + 1, first + 2, first + 3});
        }
    }
    return mesh;
}

}  // namespace

MarkPass::MarkPass(gpu::Device& device, const scene::Lights& lights)
    : meshes_{draw::MeshInstances(device, discMesh(), lights, true),
              draw::MeshInstances(device, ballMesh(), lights, false),
              draw::MeshInstances(device, crossMesh(), lights, false)} {}

void MarkPass::upload(std::span<const particles::Mark> marks) {
    for (std::size_t shape = 0; shape < meshes_.size(); ++shape) {
        const auto isShape = [&](const particles::Mark& mark) { return static_cast<std::size_t>(mark.shape) == shape; };
        float* value = meshes_[shape].map(static_cast<std::size_t>(std::ranges::count_if(marks, isShape))).data();
        for (const particles::Mark& m : marks)
            if (isShape(m))
                for (const float number : {m.place.x, m.place.y, m.place.z, m.radiusMetres, 0.999f, m.normal.x,
                                           m.normal.y, m.normal.z, m.colour.r, m.colour.g, m.colour.b})
                    *value++ = number;
        meshes_[shape].unmap();
    }
}

void MarkPass::draw(const scene::View& view, const gpu::Layer& layer) {
    for (draw::MeshInstances& mesh : meshes_)
        if (mesh.count() > 0) mesh.draw(view, layer);
}

}  // namespace dustbench::plugin_particles
