#include "methods/kit/draw/cubes.h"

#include <cstdint>
#include <vector>

#include "draw_shaders.h"

namespace dustbench::draw {
namespace {

/// Gives an instance as many vertices as for billboards.
constexpr std::size_t cubesAtOnce = 32;

/// Corner bits 1, 2, 4 are set on the side towards the eye along x, y, z; the vertex shader resolves that side.
std::vector<std::uint32_t> cornersOfACube() {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t towardsTheEye : {0u, 1u})
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t face = towardsTheEye << axis;
            const std::uint32_t u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
            for (const std::uint32_t corner : {face, face | u, face | v, face | v, face | u, face | u | v})
                corners.push_back(corner);
        }
    return corners;
}

}  // namespace

Cubes::Cubes(gpu::Device& device)
    : InstanceBatch(device,
                    {"cubes", draw_shaders::cubes_vert, draw_shaders::cubes_frag, cornersOfACube(), 8, cubesAtOnce}) {}

void Cubes::draw(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer) {
    if (count() == 0) return;
    gpu::Program& program = this->program(view);
    if (!layoutOfAll().coloured) program.set("colourOfAll", colourOfAll);
    drawWithinScene(program, view, layer);
}

}  // namespace dustbench::draw
