#include "methods/kit/octree/gpu/gpu_march.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/sort/scan.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/octree/octree_march.h"
#include "octree_gpu_shaders.h"
#include "octree_shaders.h"

namespace dustbench::octree {
namespace {

namespace marched = octree_gpu_shaders;

constexpr std::size_t marchWord = sizeof(std::uint32_t), slotsPerBlock = 8;
/// Of the tally of voxels.
constexpr std::size_t voxelGroupsAt = marchWord;

/// Blocks of the largest tree of so many voxels: in each level at most one for each voxel, and 8^level.
std::uint64_t mostBlocks(std::uint64_t voxels) {
    std::uint64_t blocks = 0;
    for (int level = 0; level < maximumDepth; ++level) blocks += std::min(voxels, std::uint64_t{1} << 3 * level);
    return std::max<std::uint64_t>(blocks, 1);
}

/// Everything whose size depends on the number of particles.
struct MarchRoom {
    MarchRoom(gpu::Device& device, std::uint32_t voxels, bool withColours)
        : capacity(voxels),
          coloured(withColours),
          rows(static_cast<int>(std::min<std::uint64_t>(
              (slotsPerBlock * mostBlocks(voxels) + marchTexelsPerRow - 1) / marchTexelsPerRow, maximumMarchRows))),
          ends(device, "octree march: blocks", voxels * marchWord),
          slots(gpu::Texture::make2D(device, "octree march slots", gpu::Format::r32F, marchTexelsPerRow, rows)),
          colours(withColours ? gpu::Texture::make2D(device, "octree march colours", gpu::Format::rgba32F,
                                                     marchTexelsPerRow, rows)
                              : gpu::Texture()),
          scan(device, voxels) {}

    std::uint32_t capacity;
    bool coloured;
    int rows;
    gpu::Buffer ends;  ///< number of blocks of each voxel and those before it
    gpu::Texture slots, colours;
    gpu::InclusiveScan scan;
};

}  // namespace

struct GpuMarch::State {
    explicit State(gpu::Device& onDevice)
        : device(onDevice),
          counts(pass(marched::block_counts_comp, false)),
          world(device, marched::march_world_comp.name, {marched::octree_glsl, marched::march_world_comp}),
          bounds(device, "octree march: world", 6 * marchWord),
          eye(device, "octree march: world", sizeof(glm::dvec4)),
          seen(device, "octree march: world", 3 * sizeof(glm::vec4)),
          vertices(device) {}

    /// The programs for trees with or without colours.
    struct Programs {
        gpu::Program blocks, links, march;
    };
    Programs& programs(bool coloured) {
        std::optional<Programs>& made = coloured ? ownColours : oneColour;
        if (made) return *made;
        std::map<std::string, std::string> definitions{{"ROW_BITS", std::to_string(marchRowBits)},
                                                       {"WORLD_ON_GPU", ""}};
        if (coloured) definitions["COLOURED"] = "";
        made.emplace(Programs{
            pass(marched::march_blocks_comp, coloured), pass(marched::march_links_comp, coloured),
            gpu::Program(device, "octree march", {octree_shaders::octree_march_vert, octree_shaders::octree_march_frag},
                         definitions)});
        return *made;
    }

    gpu::Device& device;
    gpu::Program counts, world;
    std::optional<Programs> oneColour, ownColours;
    gpu::Buffer bounds;  ///< minimum and maximum finest cell
    gpu::Buffer eye, seen;
    gpu::VertexArray vertices;
    std::optional<MarchRoom> room;

 private:
    gpu::Program pass(const gpu::ShaderFile& file, bool coloured) {
        std::map<std::string, std::string> definitions{{"ROW_BITS", std::to_string(marchRowBits)}};
        if (coloured) definitions["COLOURED"] = "";
        std::vector<gpu::ShaderFile> files{marched::octree_glsl, marched::nodes_glsl};
        if (file.name != marched::block_counts_comp.name) files.push_back(marched::march_nodes_glsl);
        files.push_back(file);
        return {device, file.name, std::span<const gpu::ShaderFile>(files), definitions};
    }
};

GpuMarch::GpuMarch(gpu::Device& device) : state_(std::make_unique<State>(device)) {}
GpuMarch::~GpuMarch() = default;

void GpuMarch::take(const GpuOctree& tree) {
    State& state = *state_;
    const bool coloured = tree.drawn().colour != nullptr;
    if (!state.room || state.room->capacity < tree.capacity() || state.room->coloured != coloured) {
        state.room.reset();
        state.room.emplace(state.device, tree.capacity(), coloured);
    }
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    const std::array<std::uint32_t, 6> boundsOfNothing{none, none, none, 0, 0, 0};
    state.bounds.write(std::span<const std::uint32_t>(boundsOfNothing));
    MarchRoom& room = *state.room;
    const gpu::Buffer& tally = *tree.drawn().tally;
    const auto bindVoxels = [&] {
        tree.bindFrame();
        tree.voxels().bindStorage(1);
        tally.bindUniform(2);
        room.ends.bindStorage(2);
    };
    bindVoxels();
    state.bounds.bindStorage(3);
    state.counts.dispatchIndirect(tally, voxelGroupsAt);
    room.scan.scan(room.ends, room.ends, tally);
    bindVoxels();
    room.slots.bindImage(0, false, true);
    if (coloured) {
        tree.drawn().colour->bindStorage(3);
        room.colours.bindImage(1, false, true);
    }
    State::Programs& programs = state.programs(coloured);
    programs.blocks.dispatchIndirect(tally, voxelGroupsAt);
    programs.links.dispatchIndirect(tally, voxelGroupsAt);
}

void GpuMarch::draw(const GpuOctree& tree, const scene::View& view, const glm::vec3& colourOfAll,
                    const gpu::Layer& layer) {
    State& state = *state_;
    if (!state.room) return;
    const glm::dvec4 eye(view.camera.eye, view.camera.nearMetres);
    state.eye.write(std::span<const glm::dvec4>(&eye, 1));
    tree.bindFrame();
    state.seen.bindStorage(2);
    state.bounds.bindStorage(3);
    state.eye.bindUniform(3);
    state.world.dispatch(1, 1, 1);

    gpu::Program& program = state.programs(state.room->coloured).march;
    const MarchRays rays = marchRays(view);
    program.set("rayCorner", glm::vec3(rays.corner));
    program.set("rayRight", glm::vec3(rays.right));
    program.set("rayUp", glm::vec3(rays.up));
    if (!state.room->coloured) program.set("colourOfAll", colourOfAll);
    state.seen.bindUniform(3);
    gpu::DrawState drawing;
    drawing.blend = gpu::Blend::premultiplied;
    layer.bindColourOnly();
    layer.sceneDepth().bind(0);
    state.room->slots.bind(1);
    if (state.room->coloured) state.room->colours.bind(2);
    gpu::draw(program, state.vertices, drawing, gpu::Primitives::triangles, 3);
}

std::uint32_t GpuMarch::readBlocks(std::uint32_t voxels) const {
    if (!state_->room || voxels == 0) return 1;
    std::vector<std::uint32_t> ends(voxels);
    state_->room->ends.read(std::span(ends));
    return ends.back();
}

std::uint32_t GpuMarch::blockLimit() const {
    return state_->room ? static_cast<std::uint32_t>(static_cast<std::size_t>(state_->room->rows) * marchTexelsPerRow /
                                                     slotsPerBlock)
                        : 0;
}

std::size_t GpuMarch::bytes() const {
    const State& state = *state_;
    std::size_t sum = state.bounds.bytes() + state.eye.bytes() + state.seen.bytes();
    if (state.room)
        sum += state.room->ends.bytes() + state.room->slots.bytes() + state.room->colours.bytes() +
               state.room->scan.bytes();
    return sum;
}

}  // namespace dustbench::octree
