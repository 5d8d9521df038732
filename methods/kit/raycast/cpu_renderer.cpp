#include "methods/kit/raycast/cpu_renderer.h"

#include <algorithm>
#include <bit>
#include <map>
#include <string>

#include "methods/kit/gpu/draw_call.h"
#include "raycast_shaders.h"

namespace dustbench::raycast {
namespace {

/// Rounds up to an eighth of a power of two, so that a picture that grows and shrinks keeps its buffer.
std::size_t roomFor(std::size_t bytes) {
    constexpr std::size_t least = std::size_t{1} << 16;
    const std::size_t step = std::bit_floor(std::max(bytes, least)) / 8;
    return std::max((bytes + step - 1) / step * step, least);
}

}  // namespace

PacketPicture PacketComposite::map(const PixelRectangle& rectangle, int channels) {
    picture_ = {rectangle, channels, {}};
    const std::size_t floats = picture_.floats(), bytes = floats * sizeof(float);
    const std::size_t room = roomFor(bytes);
    if (values_.bytes() < room || values_.bytes() > 2 * room) values_ = gpu::Buffer(device_, "ray cast picture", room);
    picture_.values = {static_cast<float*>(values_.mapForWriting(bytes)), floats};
    return picture_;
}

void PacketComposite::draw(const glm::vec3& reflected, const gpu::Layer& layer) {
    values_.unmap();
    std::optional<gpu::Program>& program = picture_.channels == 1 ? programs_->alphaAlone : programs_->withColour;
    if (!program) {
        std::map<std::string, std::string> definitions;
        if (picture_.channels == 1) definitions["ALPHA_ALONE"] = "";
        program.emplace(device_, "ray cast composite",
                        std::initializer_list<gpu::ShaderFile>{raycast_shaders::rectangle_vert,
                                                               raycast_shaders::packet_composite_frag},
                        definitions);
    }
    if (picture_.channels == 1) program->set("reflected", reflected);
    program->set("rectangle", picture_.rectangle.inClipSpace(layer.width(), layer.height()));
    program->set("corner", glm::vec2(picture_.rectangle.left, picture_.rectangle.bottom));
    program->set("packetsAcross", picture_.packetsAcross());
    gpu::DrawState state;
    state.blend = gpu::Blend::premultiplied;
    layer.bindColourOnly();
    values_.bindStorage(0);
    gpu::draw(*program, vertices_, state, gpu::Primitives::triangleStrip, 4);
}

CpuRenderer::CpuRenderer(gpu::Device& device, const RaycastSettings& settings, const Reflected& reflected,
                         MemoryLedger& ledger)
    : settings_(settings), reflected_(reflected), ledger_(ledger), march_(settings, ledger), composite_(device) {}

CpuRenderer::CpuRenderer(Beside, const CpuRenderer& sibling)
    : settings_(sibling.settings_),
      reflected_(sibling.reflected_),
      ledger_(sibling.ledger_),
      march_(settings_, ledger_),
      composite_(Beside(), sibling.composite_) {}

std::unique_ptr<GridRenderer> CpuRenderer::another() const {
    return std::make_unique<CpuRenderer>(Beside(), *this);
}

void CpuRenderer::upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) {
    march_.upload(grid, bricks, light);
}

std::int64_t CpuRenderer::draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer,
                               SceneDepthCopy& sceneDepth) {
    const PixelRectangle pixels = pixelsOf(place.grid, place.minimum, place.maximum, view);
    if (pixels.empty()) return 0;
    const SceneDepths depths = sceneDepth.depths();
    const PacketPicture picture = composite_.map(pixels, march_.channels());
    march_.march(PixelRays(place.grid, view), depths, reflected_, picture, place.thickness);
    composite_.draw(reflected_.all(), layer);
    return pixels.count();
}

}  // namespace dustbench::raycast
