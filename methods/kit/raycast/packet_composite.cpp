#include "methods/kit/raycast/packet_composite.h"

#include <map>
#include <string>

#include "methods/kit/gpu/draw_call.h"
#include "raycast_shaders.h"

namespace dustbench::raycast {

PacketPicture PacketComposite::map(const PixelRectangle& rectangle, int channels) {
    picture_ = {rectangle, channels, {}};
    const std::size_t floats = picture_.floats(), bytes = floats * sizeof(float);
    if (values_.bytes() < bytes) values_ = gpu::Buffer(device_, "ray cast picture", bytes + bytes / 8);
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
