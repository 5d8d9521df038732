#include "methods/kit/raycast/iso_surface_pass.h"

#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/raycast/iso_surface.h"
#include "raycast_shaders.h"

namespace dustbench::raycast {

using Vertex = IsoSurface::Vertex;

IsoSurfacePass::IsoSurfacePass(gpu::Device& device, const RaycastSettings& settings, const scene::Lights& lights)
    : device_(device),
      settings_(settings),
      lights_(lights),
      surface_(device, "isosurface", {raycast_shaders::iso_surface_vert, raycast_shaders::iso_surface_frag}),
      composite_(device, "isosurface composite",
                 {raycast_shaders::rectangle_vert, raycast_shaders::iso_composite_frag}),
      vertices_(device),
      noVertices_(device) {}

void IsoSurfacePass::upload(const ShownGrid& grid, const BrickMap&, const LightVolume*) {
    const IsoSurface found = isoSurface(grid, settings_.isoDensity);
    originMetres_ = grid.originMetres;
    indexCount_ = found.indices.size();
    if (indexCount_ == 0) return;
    vertexBuffer_ = gpu::Buffer(device_, "isosurface vertices", std::span<const Vertex>(found.vertices));
    indexBuffer_ = gpu::Buffer(device_, "isosurface indices", std::span<const std::uint32_t>(found.indices));
    vertices_ = gpu::VertexArray(device_);
    vertices_.attribute(0, 3, vertexBuffer_, sizeof(Vertex), offsetof(Vertex, place));
    vertices_.attribute(1, 3, vertexBuffer_, sizeof(Vertex), offsetof(Vertex, normal));
    vertices_.indices(indexBuffer_);
}

std::int64_t IsoSurfacePass::draw(const GridPlace&, const scene::View& view, const gpu::Layer& layer) {
    if (indexCount_ == 0) return 0;
    if (colour_.bytes() == 0 || colour_.width() != layer.width() || colour_.height() != layer.height()) {
        colour_ = gpu::Texture::make2D(device_, "isosurface", gpu::Format::rgba32F, layer.width(), layer.height());
        depth_ =
            gpu::Texture::make2D(device_, "isosurface depth", gpu::Format::depth32F, layer.width(), layer.height());
        target_ = gpu::Framebuffer(device_, "isosurface", &colour_, &depth_);
    }
    target_.clearColour(0, 0, 0, 0);
    target_.clearDepth();
    target_.bind();
    const glm::mat4 eyeToClip = view.eyeToClip();
    surface_.set("fromEye", glm::vec3(originMetres_ - view.camera.eye));
    surface_.set("worldToEye", view.worldToEye());
    surface_.set("projection", glm::vec3(eyeToClip[0][0], eyeToClip[1][1], view.camera.nearMetres));
    surface_.set("toSun", lights_.toSun);
    surface_.set("sky", settings_.smokeColour * lights_.ambient);
    surface_.set("sun", settings_.smokeColour * lights_.sun);
    layer.sceneDepth().bind(0);
    gpu::DrawState own;
    own.depthTest = own.depthWrite = true;
    gpu::drawIndexed(surface_, vertices_, own, gpu::Primitives::triangles, static_cast<int>(indexCount_));

    layer.bindColourOnly();
    colour_.bind(0);
    composite_.set("rectangle", glm::vec4(-1, -1, 1, 1));
    gpu::DrawState over;
    over.blend = gpu::Blend::premultiplied;
    gpu::draw(composite_, noVertices_, over, gpu::Primitives::triangleStrip, 4);
    return static_cast<std::int64_t>(indexCount_ / 3);
}

}  // namespace dustbench::raycast
