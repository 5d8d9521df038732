#include "methods/kit/draw/solid_mesh.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

namespace dustbench::draw {
namespace {

struct Vertex {
    glm::vec3 position, normal, colour;
};

}  // namespace

SolidMesh::SolidMesh(gpu::Device& device, const scene::Solid& solid) : layout_(device) {
    if (!solid.mesh || solid.mesh->positions.empty()) throw std::invalid_argument("solid without vertices");
    const scene::Mesh& mesh = *solid.mesh;
    if (mesh.normals.size() != mesh.positions.size() || mesh.colours.size() != mesh.positions.size())
        throw std::invalid_argument("solid '" + solid.name + "': expected one normal and one colour per vertex");

    vertexCount_ = mesh.positions.size();
    vertices_ = gpu::Buffer(device, "solid vertices", vertexCount_ * sizeof(Vertex));
    write(mesh);
    indices_ = gpu::Buffer(device, "solid indices", std::span<const std::uint32_t>(mesh.indices));
    indexCount_ = static_cast<int>(mesh.indices.size());
    layout_.attribute(0, 3, vertices_, sizeof(Vertex), offsetof(Vertex, position));
    layout_.attribute(1, 3, vertices_, sizeof(Vertex), offsetof(Vertex, normal));
    layout_.attribute(2, 3, vertices_, sizeof(Vertex), offsetof(Vertex, colour));
    layout_.indices(indices_);
}

void SolidMesh::reshape(const scene::Mesh& mesh) {
    if (mesh.positions.size() != vertexCount_ || mesh.normals.size() != vertexCount_ ||
        mesh.colours.size() != vertexCount_)
        throw std::invalid_argument("SolidMesh: the shape has a different number of vertices");
    write(mesh);
}

void SolidMesh::write(const scene::Mesh& mesh) {
    minimum_ = glm::vec3(INFINITY);
    maximum_ = glm::vec3(-INFINITY);
    std::vector<Vertex> vertices;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        vertices.push_back({mesh.positions[i], mesh.normals[i], mesh.colours[i]});
        minimum_ = glm::min(minimum_, mesh.positions[i]);
        maximum_ = glm::max(maximum_, mesh.positions[i]);
    }
    radius_ = 0;
    for (const glm::vec3& position : mesh.positions) radius_ = std::max(radius_, glm::distance(position, centre()));
    vertices_.write(std::span<const Vertex>(vertices));
}

void SolidMesh::draw(const gpu::Program& program, const gpu::DrawState& state, int instances) const {
    gpu::drawIndexed(program, layout_, state, gpu::Primitives::triangles, indexCount_, instances);
}

}  // namespace dustbench::draw
