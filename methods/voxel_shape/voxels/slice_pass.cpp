#include "methods/voxel_shape/voxels/slice_pass.h"

#include <memory>
#include <type_traits>

#include "methods/kit/draw/solid_mesh.h"
#include "methods/kit/gpu/framebuffer.h"
#include "voxel_shape_voxels_shaders.h"

namespace dustbench::voxel_shape {
namespace {

/// Converts a mesh for draw::SolidMesh; adds missing normals and colours.
scene::Solid solidOf(const scene::Mesh& mesh) {
    auto whole = std::make_shared<scene::Mesh>(mesh);
    whole->normals.resize(mesh.positions.size(), glm::vec3(0, 1, 0));
    whole->colours.resize(mesh.positions.size(), glm::vec3(1));
    return {"voxelised mesh", std::move(whole)};
}

}  // namespace

MarkedVoxels slicePass(gpu::Device& device, const scene::Mesh& mesh, const Lattice& lattice,
                       const glm::vec3& background) {
    requireSoundMesh(mesh, "voxels of a mesh");
    const int width = lattice.counts.x, height = lattice.counts.y;
    const auto colour = gpu::Texture::make2D(device, "voxel slice colours", gpu::Format::rgba32F, width, height);
    const auto depth = gpu::Texture::make2D(device, "voxel slice depths", gpu::Format::depth32F, width, height);
    const gpu::Framebuffer target(device, "voxel slice", &colour, &depth);
    const draw::SolidMesh solid(device, solidOf(mesh));
    gpu::Program program(device, "voxel slices",
                         {voxel_shape_voxels_shaders::slice_vert, voxel_shape_voxels_shaders::slice_frag});
    program.set("origin", lattice.origin);
    program.set("edge", lattice.edgeMetres);
    program.set("counts", glm::vec2(lattice.counts));
    gpu::DrawState state;
    state.depthTest = state.depthWrite = true;

    MarkedVoxels result(lattice);
    const auto layerSize = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    for (int layer = 0; layer < lattice.counts.z; ++layer) {
        target.bind();
        target.clearColour(background.r, background.g, background.b, 1);
        target.clearDepth();
        program.set("layer", static_cast<float>(layer));
        solid.draw(program, state);
        const std::vector<float> depths = depth.readFloats();
        const std::vector<float> colours = colour.readFloats();
        const std::size_t first = lattice.index({0, 0, layer});  // texture rows count from the bottom, like y
        for (std::size_t i = 0; i < layerSize; ++i)
            if (depths[i] > 0) {
                result.marked[first + i] = 1;
                result.colours[first + i] = {colours[4 * i], colours[4 * i + 1], colours[4 * i + 2]};
            }
    }
    return result;
}

MarkedVoxels slicesAlongAllAxes(gpu::Device& device, const scene::Mesh& mesh, const Lattice& lattice) {
    MarkedVoxels result(lattice);
    for (int turns = 0; turns < 3; ++turns) {
        // (x, y, z) → (y, z, x), `turns` times, so that each axis becomes the viewing direction once.
        const auto turned = [turns](const auto& v) {
            return std::decay_t<decltype(v)>(v[turns % 3], v[(turns + 1) % 3], v[(turns + 2) % 3]);
        };
        scene::Mesh turnedMesh = mesh;
        for (glm::vec3& position : turnedMesh.positions) position = turned(position);
        const MarkedVoxels found =
            slicePass(device, turnedMesh, {turned(lattice.counts), turned(lattice.origin), lattice.edgeMetres});
        for (std::uint32_t i = 0; i < lattice.size(); ++i) {
            const std::uint32_t there = found.lattice.index(turned(lattice.cell(i)));
            if (!found.marked[there] || result.marked[i]) continue;
            result.marked[i] = 1;
            result.colours[i] = found.colours[there];
        }
    }
    return result;
}

}  // namespace dustbench::voxel_shape
