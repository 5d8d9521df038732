// Draws a mesh for each particle.
#include "methods/kit/draw/mesh_instances.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/meshes/mesh_file.h"
#include "methods/plugin_particles/shape_pass.h"

namespace dustbench::plugin_particles {
namespace {

scene::Mesh meshOf(const particles::Look& look) {
    return meshes::readMesh(files::findData("mesh", "scenes/meshes", look.mesh, ".obj"), glm::vec3(1));
}

class ObjectPass final : public ShapePass {
 public:
    ObjectPass(gpu::Device& device, const particles::Look& look, const scene::Lights& lights)
        : meshes_(device, meshOf(look), lights, look.alongVelocity) {}

    void upload(const Drawn& drawn) override {
        const Puffs& p = drawn.puffs;
        fill(meshes_.map(p.size()), draw::MeshInstances::floats, drawn, [&](float* value, std::size_t i) {
            const glm::vec3 colour = p.colour(i);
            for (const float next : {p.x[i], p.y[i], p.z[i], p.radius[i], p.opacity[i], p.velocityX[i], p.velocityY[i],
                                     p.velocityZ[i], colour.r, colour.g, colour.b})
                *value++ = next;
        });
        meshes_.unmap();
    }
    void draw(const scene::View& view, const gpu::Layer& layer) override { meshes_.draw(view, layer); }
    [[nodiscard]] std::size_t count() const override { return meshes_.count(); }
    [[nodiscard]] std::size_t gpuBytes() const override { return meshes_.gpuBytes(); }

 private:
    draw::MeshInstances meshes_;
};

}  // namespace

std::unique_ptr<ShapePass> makeObjectPass(gpu::Device& device, const particles::Look& look,
                                          const scene::Lights& lights) {
    return std::make_unique<ObjectPass>(device, look, lights);
}

}  // namespace dustbench::plugin_particles
