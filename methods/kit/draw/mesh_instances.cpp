#include "methods/kit/draw/mesh_instances.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include "draw_shaders.h"

namespace dustbench::draw {
namespace {

scene::Solid solidOf(const scene::Mesh& mesh) {
    scene::Solid solid;
    solid.name = "particle";
    solid.mesh = std::make_shared<scene::Mesh>(mesh);
    return solid;
}

std::map<std::string, std::string> meshDefinitions(bool alongVelocity) {
    if (alongVelocity) return {{"ALONG_VELOCITY", ""}};
    return {};
}

}  // namespace

MeshInstances::MeshInstances(gpu::Device& device, const scene::Mesh& mesh, const scene::Lights& lights,
                             bool alongVelocity)
    : device_(device),
      mesh_(device, solidOf(mesh)),
      lights_(lights),
      program_(device, "mesh instances", {draw_shaders::mesh_instances_vert, draw_shaders::mesh_instances_frag},
               meshDefinitions(alongVelocity)),
      blend_(device) {}

std::span<float> MeshInstances::map(std::size_t count) {
    count_ = count;
    const std::size_t bytes = count * floats * sizeof(float);
    if (bytes == 0) return {};
    if (bytes > instances_.bytes()) instances_ = gpu::Buffer(device_, "mesh instances", bytes + bytes / 8);
    return {static_cast<float*>(instances_.mapForWriting(bytes)), count * floats};
}

void MeshInstances::unmap() {
    if (count_ > 0) instances_.unmap();
}

void MeshInstances::fit(const gpu::Layer& layer) {
    if (colour_.width() == layer.width() && colour_.height() == layer.height()) return;
    colour_ = gpu::Texture::make2D(device_, "mesh picture", gpu::Format::rgba32F, layer.width(), layer.height());
    depth_ = gpu::Texture::make2D(device_, "mesh depth", gpu::Format::depth32F, layer.width(), layer.height());
    target_ = gpu::Framebuffer(device_, "mesh picture", &colour_, &depth_);
}

void MeshInstances::draw(const scene::View& view, const gpu::Layer& layer) {
    if (count_ == 0) return;
    fit(layer);
    target_.clearColour(0, 0, 0, 0);
    target_.clearDepth();
    target_.bind();
    const glm::mat4 eyeToClip = view.eyeToClip();
    program_.set("eye", glm::vec3(view.camera.eye));
    program_.set("worldToEye", view.worldToEye());
    program_.set("projection", glm::vec3(eyeToClip[0][0], eyeToClip[1][1], view.camera.nearMetres));
    program_.set("middle", glm::vec4(mesh_.centre(), 1 / std::max(mesh_.radiusMetres(), 1e-20f)));
    program_.set("toSun", lights_.toSun);
    program_.set("sun", lights_.sun);
    program_.set("ambient", lights_.ambient);
    instances_.bindStorage(0);
    layer.sceneDepth().bind(1);
    gpu::DrawState state;
    state.depthTest = state.depthWrite = true;
    mesh_.draw(program_, state, static_cast<int>(count_));
    blend_.over(colour_, layer);
}

std::size_t MeshInstances::gpuBytes() const {
    return instances_.bytes() + colour_.bytes() + depth_.bytes();
}

}  // namespace dustbench::draw
