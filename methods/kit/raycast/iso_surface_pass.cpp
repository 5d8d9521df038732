#include "methods/kit/raycast/iso_surface_pass.h"

#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/raycast/iso_surface.h"
#include "raycast_shaders.h"

namespace dustbench::raycast {

using Vertex = IsoSurface::Vertex;

IsoSurfacePass::Shared::Shared(gpu::Device& device)
    : surface(device, "isosurface", {raycast_shaders::iso_surface_vert, raycast_shaders::iso_surface_frag}),
      composite(device, "isosurface composite",
                {raycast_shaders::rectangle_vert, raycast_shaders::iso_composite_frag}) {}

IsoSurfacePass::IsoSurfacePass(gpu::Device& device, const RaycastSettings& settings, const scene::Lights& lights)
    : device_(device),
      settings_(settings),
      lights_(lights),
      shared_(std::make_shared<Shared>(device)),
      vertices_(device),
      noVertices_(device) {}

IsoSurfacePass::IsoSurfacePass(Beside, const IsoSurfacePass& sibling)
    : device_(sibling.device_),
      settings_(sibling.settings_),
      lights_(sibling.lights_),
      shared_(sibling.shared_),
      first_(false),
      vertices_(device_),
      noVertices_(device_) {}

std::unique_ptr<GridRenderer> IsoSurfacePass::another() const {
    return std::make_unique<IsoSurfacePass>(Beside(), *this);
}

void IsoSurfacePass::upload(const ShownGrid& grid, const BrickMap&, const LightVolume*) {
    const IsoSurface found = isoSurface(grid, settings_.isoDensity);
    indexCount_ = found.indices.size();
    if (indexCount_ == 0) return;
    vertexBuffer_ = gpu::Buffer(device_, "isosurface vertices", std::span<const Vertex>(found.vertices));
    indexBuffer_ = gpu::Buffer(device_, "isosurface indices", std::span<const std::uint32_t>(found.indices));
    vertices_ = gpu::VertexArray(device_);
    vertices_.attribute(0, 3, vertexBuffer_, sizeof(Vertex), offsetof(Vertex, place));
    vertices_.attribute(1, 3, vertexBuffer_, sizeof(Vertex), offsetof(Vertex, normal));
    vertices_.indices(indexBuffer_);
}

std::int64_t IsoSurfacePass::draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer,
                                  SceneDepthCopy&) {
    if (indexCount_ == 0) return 0;
    Shared& shared = *shared_;
    if (shared.colour.bytes() == 0 || shared.colour.width() != layer.width() ||
        shared.colour.height() != layer.height()) {
        shared.colour =
            gpu::Texture::make2D(device_, "isosurface", gpu::Format::rgba32F, layer.width(), layer.height());
        shared.depth =
            gpu::Texture::make2D(device_, "isosurface depth", gpu::Format::depth32F, layer.width(), layer.height());
        shared.target = gpu::Framebuffer(device_, "isosurface", &shared.colour, &shared.depth);
    }
    shared.target.clearColour(0, 0, 0, 0);
    shared.target.clearDepth();
    shared.target.bind();
    const glm::mat4 eyeToClip = view.eyeToClip();
    shared.surface.set("fromEye", glm::vec3(place.grid.originMetres - view.camera.eye));
    shared.surface.set("worldToEye", view.worldToEye());
    shared.surface.set("projection", glm::vec3(eyeToClip[0][0], eyeToClip[1][1], view.camera.nearMetres));
    shared.surface.set("toSun", lights_.toSun);
    shared.surface.set("sky", settings_.smokeColour * lights_.ambient);
    shared.surface.set("sun", settings_.smokeColour * lights_.sun);
    layer.sceneDepth().bind(0);
    gpu::DrawState own;
    own.depthTest = own.depthWrite = true;
    gpu::drawIndexed(shared.surface, vertices_, own, gpu::Primitives::triangles, static_cast<int>(indexCount_));

    layer.bindColourOnly();
    shared.colour.bind(0);
    shared.composite.set("rectangle", glm::vec4(-1, -1, 1, 1));
    gpu::DrawState over;
    over.blend = gpu::Blend::premultiplied;
    gpu::draw(shared.composite, noVertices_, over, gpu::Primitives::triangleStrip, 4);
    return static_cast<std::int64_t>(indexCount_ / 3);
}

}  // namespace dustbench::raycast
