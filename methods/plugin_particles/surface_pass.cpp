// Draws the surface of a lattice of particles as one mesh, made anew from their positions for each picture.
//
// The mesh is drawn by the pass for meshes in place of particles, with one instance that leaves it where it is.
#include <algorithm>
#include <array>
#include <optional>

#include "methods/kit/draw/mesh_instances.h"
#include "methods/kit/particles/lattice_surface.h"
#include "methods/plugin_particles/shape_pass.h"

namespace dustbench::plugin_particles {
namespace {

class SurfacePass final : public ShapePass {
 public:
    SurfacePass(gpu::Device& device, const particles::Look& look, const scene::Lights& lights)
        : device_(device), look_(look), lights_(lights) {}

    void upload(const Drawn& drawn) override;
    void draw(const scene::View& view, const gpu::Layer& layer) override {
        if (mesh_) mesh_->draw(view, layer);
    }
    [[nodiscard]] std::size_t count() const override { return shape_.indices.size() / 3; }
    [[nodiscard]] std::size_t gpuBytes() const override { return mesh_ ? mesh_->gpuBytes() : 0; }
    [[nodiscard]] std::size_t cpuBytes() const override {
        return surface_.bytes() + 3 * shape_.positions.capacity() * sizeof(glm::vec3) +
               shape_.indices.capacity() * sizeof(std::uint32_t);
    }

 private:
    using Vertex = particles::LatticeSurface::Vertex;

    [[nodiscard]] float brightnessOf(const Vertex& vertex) const {
        if (look_.squares == 0) return 1;
        const glm::ivec2 square = vertex.node / look_.squares;
        return (square.x + square.y) % 2 == 0 ? 1 : look_.darkShare;
    }
    void shape(const Puffs& puffs);

    gpu::Device& device_;
    particles::Look look_;
    scene::Lights lights_;
    particles::LatticeSurface surface_;
    scene::Mesh shape_;
    std::optional<draw::MeshInstances> mesh_;
};

void SurfacePass::shape(const Puffs& puffs) {
    const auto vertices = surface_.vertices();
    for (auto* column : {&shape_.positions, &shape_.normals, &shape_.colours}) column->resize(vertices.size());
    parallel::forEachBlock(vertices.size(), 4096, [&](std::size_t first, std::size_t count) {
        for (std::size_t k = first; k < first + count; ++k) {
            const Vertex& v = vertices[k];
            shape_.positions[k] = puffs.position(v.particle);
            shape_.normals[k] = particles::LatticeSurface::normalOf(v, [&](auto i) { return puffs.position(i); });
            shape_.colours[k] = brightnessOf(v) * puffs.colour(v.particle);
        }
    });
}

void SurfacePass::upload(const Drawn& drawn) {
    const Puffs& puffs = drawn.puffs;
    const bool changed = surface_.follow(look_.lattice, puffs.serial);
    shape(puffs);
    if (changed) {
        shape_.indices.assign(surface_.triangles().begin(), surface_.triangles().end());
        mesh_.reset();
        if (!shape_.indices.empty()) mesh_.emplace(device_, shape_, lights_, false);
    }
    if (!mesh_) return;
    mesh_->reshape(shape_);
    const glm::vec3 centre = mesh_->centre();
    const std::span<float> value = mesh_->map(1);
    const std::array<float, draw::MeshInstances::floats> inPlace{
        centre.x, centre.y, centre.z, mesh_->radiusMetres(), puffs.opacity[0], 0, 0, 0, 1, 1, 1};
    std::ranges::copy(inPlace, value.begin());
    mesh_->unmap();
}

}  // namespace

std::unique_ptr<ShapePass> makeSurfacePass(gpu::Device& device, const particles::Look& look,
                                           const scene::Lights& lights) {
    return std::make_unique<SurfacePass>(device, look, lights);
}

}  // namespace dustbench::plugin_particles
