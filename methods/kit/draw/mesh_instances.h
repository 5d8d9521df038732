// Draws a mesh in place of each particle, in one instanced draw call.
//
// Meshes hide each other and are hidden by the scene: they are drawn with a separate depth buffer, and the nearest mesh
// of each pixel is blended over the layer with its particle's opacity. A mesh is centred on its particle and scaled so
// that its bounding sphere has the particle's radius. Light: matt, by the scene's sun and sky, without shadows.
//
// Units: m. Frame: world. Colours: linear RGB, the particle's times the mesh's. Owns: the mesh, the instances and a
// picture of the layer's size. Threads: the OpenGL thread. Source: Thesis, 4.1.7.
#pragma once

#include <optional>

#include "methods/contract/scene.h"
#include "methods/contract/view.h"
#include "methods/kit/draw/layer_blend.h"
#include "methods/kit/draw/solid_mesh.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/framebuffer.h"

namespace dustbench::draw {

class DUSTBENCH_API MeshInstances {
 public:
    /// `alongVelocity`: the mesh's x axis follows the velocity; otherwise all keep the mesh's own orientation.
    MeshInstances(gpu::Device& device, const scene::Mesh& mesh, const scene::Lights& lights, bool alongVelocity);

    /// Replaces the mesh by one with the same triangles.
    void reshape(const scene::Mesh& mesh) { mesh_.reshape(mesh); }
    /// Of the mesh's bounding sphere.
    [[nodiscard]] glm::vec3 centre() const { return mesh_.centre(); }
    [[nodiscard]] float radiusMetres() const { return mesh_.radiusMetres(); }

    /// x y z radius opacity velocity (3) red green blue
    static constexpr std::size_t floats = 11;
    /// GPU memory for `count` meshes; write-only; fill it, then call `unmap`.
    [[nodiscard]] std::span<float> map(std::size_t count);
    void unmap();

    /// Draws the instances mapped last; may be called repeatedly.
    void draw(const scene::View& view, const gpu::Layer& layer);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    void fit(const gpu::Layer& layer);

    gpu::Device& device_;
    SolidMesh mesh_;
    scene::Lights lights_;
    gpu::Program program_;
    gpu::Buffer instances_;
    gpu::Texture colour_, depth_;
    gpu::Framebuffer target_;
    LayerBlend blend_;
    std::size_t count_ = 0;
};

}  // namespace dustbench::draw
