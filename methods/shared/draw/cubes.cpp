#include "methods/shared/draw/cubes.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "draw_shaders.h"
#include "methods/shared/gpu/draw_call.h"

namespace dustbench::draw {
namespace {

/// Cubes in one instance: as many vertices as a billboards' instance has, for the same reason.
constexpr std::size_t cubesAtOnce = 32;
constexpr std::size_t indicesOfACube = 36;

/// Corner bits 1, 2, 4 are set towards the eye along x, y, z; the vertex shader knows where that is.
gpu::Buffer makeCorners(gpu::Device& device) {
    std::vector<std::uint32_t> corners;
    corners.reserve(cubesAtOnce * indicesOfACube);
    for (std::uint32_t cube = 0; cube < cubesAtOnce; ++cube)
        for (const std::uint32_t towardsTheEye : {0u, 1u})
            for (std::uint32_t axis = 0; axis < 3; ++axis) {
                const std::uint32_t face = towardsTheEye << axis;
                const std::uint32_t u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
                for (const std::uint32_t corner : {face, face | u, face | v, face | v, face | u, face | u | v})
                    corners.push_back(8 * cube + corner);
            }
    return {device, "cube corners", std::span<const std::uint32_t>(corners)};
}

}  // namespace

Cubes::Cubes(gpu::Device& device) : device_(device), corners_(makeCorners(device)), vertices_(device) {
    vertices_.indices(corners_);
}

std::span<float> Cubes::map(std::size_t count, const Layout& layout) {
    count_ = count;
    layout_ = layout;
    const std::size_t floats = count * layout.floats;
    if (floats == 0) return {};
    if (floats * sizeof(float) > instances_.bytes())
        instances_ = gpu::Buffer(device_, "cubes", (floats + floats / 8) * sizeof(float));
    return {static_cast<float*>(instances_.mapForWriting(floats * sizeof(float))), floats};
}

void Cubes::unmap() {
    if (count_ > 0) instances_.unmap();
}

gpu::Program& Cubes::program() {
    std::optional<gpu::Program>& made = layout_.coloured ? ownColours_ : oneColour_;
    if (!made) {
        std::map<std::string, std::string> definitions{{"CUBES_AT_ONCE", std::to_string(cubesAtOnce)},
                                                       {"FLOATS", std::to_string(layout_.floats)}};
        if (layout_.coloured) definitions["COLOURED"] = "";
        made.emplace(device_, "cubes",
                     std::initializer_list<gpu::ShaderFile>{draw_shaders::cubes_vert, draw_shaders::cubes_frag},
                     definitions);
    }
    return *made;
}

void Cubes::draw(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer) {
    if (count_ == 0) return;
    const glm::mat4 eyeToClip = view.eyeToClip();
    gpu::Program& program = this->program();
    program.set("count", static_cast<int>(count_));
    program.set("eye", glm::vec3(view.camera.eye));
    program.set("worldToEye", view.worldToEye());
    program.set("projection", glm::vec3(eyeToClip[0][0], eyeToClip[1][1], view.camera.nearMetres));
    if (!layout_.coloured) program.set("colourOfAll", colourOfAll);

    gpu::DrawState state;
    state.blend = gpu::Blend::premultiplied;
    state.depthTest = true;
    layer.bindWithSceneDepth();
    instances_.bindStorage(0);
    gpu::drawIndexed(program, vertices_, state, gpu::Primitives::triangles,
                     static_cast<int>(indicesOfACube * cubesAtOnce),
                     static_cast<int>((count_ + cubesAtOnce - 1) / cubesAtOnce));
}

}  // namespace dustbench::draw
