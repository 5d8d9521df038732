#include "methods/kit/raycast/packet_composite.h"

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

}  // namespace dustbench::raycast
