#include "methods/kit/octree/gpu/gpu_octree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>

#include "gpu_sort_shaders.h"
#include "methods/contract/errors.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/sort/radix_sort.h"
#include "methods/kit/gpu/sort/scan.h"
#include "methods/kit/octree/cell_kernel.h"
#include "octree_gpu_shaders.h"

namespace dustbench::octree {
namespace {

namespace shaders = octree_gpu_shaders;

constexpr std::size_t wordBytes = sizeof(std::uint32_t);
constexpr std::uint32_t leastParticles = 4096, blockBits = 4;
constexpr int blockLevels = 3;

/// The uniform block `Moment` of octree.glsl, by the rules of std140.
struct alignas(32) MomentValues {
    glm::dvec4 vehicle{0}, edges{0};
    glm::ivec4 tree{0}, rules{0};
    glm::vec4 scales{0};
    glm::ivec4 drawn{0};
    glm::vec4 shown{0};
};

/// `State` of octree.glsl.
struct StateValues {
    glm::dvec4 origin{0};
    glm::ivec4 first{0};
    glm::uvec4 counts{0}, secondGroups{0}, blockGroups[blockLevels]{}, maxima{0};
};
constexpr std::size_t secondKeysWord = offsetof(StateValues, counts) / wordBytes + 3;
constexpr std::size_t secondGroupsAt = offsetof(StateValues, secondGroups);
constexpr std::size_t blockGroupsAt = offsetof(StateValues, blockGroups);
/// In the tally of dust and of voxels.
constexpr std::size_t tallyGroupsAt = wordBytes;

MomentValues momentOf(const DustSettings& settings, const glm::dvec3& vehicle, bool maximaBegin) {
    Lattice smallest;
    smallest.edgeMetres = settings.worldEdgeMetres;
    smallest.depth = settings.tree.depth;
    const double finest = smallest.cellEdgeMetres(smallest.depth);
    MomentValues moment;
    moment.vehicle = {vehicle, settings.worldEdgeMetres};
    moment.edges = {finest, smallest.cellEdgeMetres(smallest.depth - settings.tree.levels + 1), 0, 0};
    moment.tree = {smallest.depth, settings.tree.levels, settings.worldGrows ? maximumDepth : smallest.depth,
                   maximaBegin ? 1 : 0};
    moment.rules = {static_cast<int>(settings.tree.policy), static_cast<int>(settings.tree.levelRule),
                    settings.opacity == draw::OpacityFrom::age ? 1 : 0, 0};
    moment.scales = {static_cast<float>(smallest.cellsPerEdge() / smallest.edgeMetres), static_cast<float>(finest),
                     edgesOfRadius, static_cast<float>(settings.youngOpacity)};
    moment.drawn.x = settings.render == Render::cubes ? 1 : 0;
    moment.shown.x = edgesPerDrawnRadius(settings.render);
    return moment;
}

}  // namespace

/// Everything whose size depends on the number of particles.
struct GpuOctree::Room {
    Room(gpu::Device& device, std::uint32_t particles, bool withColours)
        : capacity(particles),
          coloured(withColours),
          places(column(device, 2)),
          keys(column(device, 1)),
          indices(column(device, 1)),
          flags(column(device, 1)),
          numbers(column(device, 1)),
          starts(column(device, 1)),
          blocks(device, "octree: blocks", blockCount() * 4 * wordBytes),
          voxels(device, "octree: voxels", particles * 4 * wordBytes),
          position(device, "octree: voxel list", particles * 3 * wordBytes),
          look(device, "octree: voxel list", particles * 2 * wordBytes),
          colour(withColours ? gpu::Buffer(device, "octree: voxel list", particles * 3 * wordBytes) : gpu::Buffer()),
          sort(device, particles),
          compaction(device, particles) {
        std::vector<std::uint32_t> ascending(particles);
        std::iota(ascending.begin(), ascending.end(), 0u);
        numbers.write(std::span<const std::uint32_t>(ascending));
    }

    /// Of all levels (blocks.glsl).
    [[nodiscard]] std::size_t blockCount() const {
        std::size_t count = 0;
        for (int level = 1; level <= blockLevels; ++level) count += (capacity >> blockBits * level) + 1;
        return count;
    }
    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = sort.bytes() + compaction.bytes();
        for (const gpu::Buffer* buffer :
             {&places, &keys, &indices, &flags, &numbers, &starts, &blocks, &voxels, &position, &look, &colour})
            sum += buffer->bytes();
        return sum;
    }

    std::uint32_t capacity;
    bool coloured;
    gpu::Buffer places, keys, indices, flags;
    gpu::Buffer numbers;  ///< 0, 1, 2 …
    gpu::Buffer starts;   ///< place of each voxel's first particle in sorted order
    gpu::Buffer blocks;   ///< sums of blocks of particles
    gpu::Buffer voxels, position, look, colour;
    gpu::RadixSort sort;
    gpu::Compaction compaction;

 private:
    [[nodiscard]] gpu::Buffer column(gpu::Device& device, std::size_t words) const {
        return {device, "octree: sorting", capacity * words * wordBytes};
    }
};

struct GpuOctree::Passes {
    explicit Passes(gpu::Device& onDevice)
        : device(onDevice),
          extents(pass(shaders::extents_comp, {gpu_sort_shaders::sortable_glsl})),
          world(pass(shaders::world_comp, {}, true)),
          keys(pass(shaders::keys_comp, {}, true)),
          secondKeys(pass(shaders::second_keys_comp, {})),
          runStarts(pass(shaders::run_starts_comp, {shaders::runs_glsl})),
          blocks(pass(shaders::blocks_comp, {shaders::runs_glsl, shaders::rule_glsl, shaders::blocks_glsl})),
          voxelTally(pass(shaders::voxel_tally_comp, {}, true)),
          voxels(pass(shaders::voxels_comp, {shaders::rule_glsl, shaders::blocks_glsl})),
          moment(device, "octree: moment", sizeof(MomentValues)),
          state(device, "octree: state", sizeof(StateValues)),
          extentKeys(device, "octree: state", 6 * wordBytes),
          tally(device, "octree: state", 4 * wordBytes) {
        state.clear();
        tally.clear();
        constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
        const std::array<std::uint32_t, 6> keysOfNothing{none, none, none, 0, 0, 0};
        extentKeys.write(std::span<const std::uint32_t>(keysOfNothing));
    }

    gpu::Program& list(bool coloured) {
        std::optional<gpu::Program>& made = coloured ? colouredList : plainList;
        if (!made) made.emplace(pass(shaders::list_comp, {}, false, coloured));
        return *made;
    }
    [[nodiscard]] std::size_t bytes() const {
        return moment.bytes() + state.bytes() + extentKeys.bytes() + tally.bytes();
    }

    gpu::Device& device;
    gpu::Program extents, world, keys, secondKeys, runStarts, blocks, voxelTally, voxels;
    std::optional<gpu::Program> plainList, colouredList;
    gpu::Buffer moment, state;
    gpu::Buffer extentKeys;
    gpu::Buffer tally;  ///< number of voxels, and the work groups for them

 private:
    gpu::Program pass(const gpu::ShaderFile& file, std::vector<gpu::ShaderFile> pieces, bool changesState = false,
                      bool coloured = false) {
        std::map<std::string, std::string> definitions;
        if (changesState) definitions["CHANGES_STATE"] = "";
        if (coloured) definitions["COLOURED"] = "";
        pieces.insert(pieces.begin(), shaders::octree_glsl);
        pieces.push_back(file);
        return {device, file.name, std::span<const gpu::ShaderFile>(pieces), definitions};
    }
};

GpuOctree::GpuOctree(gpu::Device& device) : device_(device), passes_(std::make_unique<Passes>(device)) {}
GpuOctree::~GpuOctree() = default;

void GpuOctree::makeRoom(const GpuPuffs& dust) {
    const bool coloured = dust.colour != nullptr;
    if (room_ && dust.bound <= room_->capacity && coloured == room_->coloured) return;
    // The largest buffer has four words for each particle.
    const std::uint64_t possible = device_.maximumStorageBytes() / (4 * wordBytes);
    if (dust.bound > possible)
        throw InputError(
            fmt::format("layout gpu: got up to {} particles, allowed: up to {}, the size of a storage buffer "
                        "on this device",
                        dust.bound, possible));
    const std::uint64_t before = room_ ? room_->capacity : leastParticles / 2;
    const std::uint64_t wanted = dust.bound <= before ? before : std::max<std::uint64_t>(dust.bound, 2 * before);
    room_.reset();
    room_ = std::make_unique<Room>(device_, static_cast<std::uint32_t>(std::min(wanted, possible)), coloured);
}

void GpuOctree::build(const GpuPuffs& dust, const DustSettings& settings, const glm::dvec3& vehicle, bool maximaBegin,
                      const StageClock& clock) {
    makeRoom(dust);
    const MomentValues moment = momentOf(settings, vehicle, maximaBegin);
    passes_->moment.write(std::span<const MomentValues>(&moment, 1));
    {
        const auto detail = clock.measureDetail("keys");
        findWorld(dust);
    }
    {
        const auto detail = clock.measureDetail("order");
        order(dust);
    }
    {
        const auto detail = clock.measureDetail("runs");
        findRuns(dust);
    }
    const auto detail = clock.measureDetail("list");
    list(dust);
}

/// The world, and the key of each particle.
void GpuOctree::findWorld(const GpuPuffs& dust) {
    Passes& pass = *passes_;
    bindFrame();
    pass.state.bindStorage(0);
    dust.position->bindStorage(1);
    dust.tally->bindStorage(2);
    pass.extentKeys.bindStorage(3);
    pass.extents.dispatchIndirect(*dust.tally, tallyGroupsAt);
    pass.world.dispatch(1, 1, 1);
    dust.life->bindStorage(3);
    dust.look->bindStorage(4);
    room_->places.bindStorage(5);
    room_->keys.bindStorage(6);
    room_->indices.bindStorage(7);
    pass.keys.dispatchIndirect(*dust.tally, tallyGroupsAt);
}

void GpuOctree::order(const GpuPuffs& dust) {
    room_->sort.sort(room_->keys, room_->indices, *dust.tally);
    room_->places.bindStorage(1);
    room_->indices.bindStorage(2);
    room_->keys.bindStorage(3);
    passes_->secondKeys.dispatchIndirect(passes_->state, secondGroupsAt);
    room_->sort.sort(room_->keys, room_->indices, {passes_->state, secondKeysWord});
}

/// The runs of particles that share a voxel, and their sums.
void GpuOctree::findRuns(const GpuPuffs& dust) {
    Passes& pass = *passes_;
    const auto bindSorted = [&] {
        room_->keys.bindStorage(1);
        room_->indices.bindStorage(2);
        room_->places.bindStorage(3);
    };
    bindSorted();
    room_->flags.bindStorage(4);
    pass.runStarts.dispatchIndirect(*dust.tally, tallyGroupsAt);
    room_->compaction.compact(room_->numbers, room_->flags, *dust.tally, room_->starts, pass.tally);
    pass.state.bindStorage(0);
    pass.tally.bindStorage(1);
    pass.voxelTally.dispatch(1, 1, 1);

    bindSorted();
    dust.life->bindStorage(4);
    dust.look->bindStorage(5);
    dust.serial->bindStorage(6);
    room_->blocks.bindStorage(7);
    pass.blocks.set("capacity", static_cast<int>(room_->capacity));
    for (int level = 0; level < blockLevels; ++level) {
        pass.blocks.set("level", level);
        pass.blocks.dispatchIndirect(pass.state, blockGroupsAt + static_cast<std::size_t>(level) * sizeof(glm::uvec4));
    }

    room_->starts.bindStorage(0);
    room_->voxels.bindStorage(1);
    pass.tally.bindUniform(2);
    pass.voxels.set("capacity", static_cast<int>(room_->capacity));
    pass.voxels.dispatchIndirect(pass.tally, tallyGroupsAt);
}

void GpuOctree::list(const GpuPuffs& dust) {
    const bool coloured = dust.colour != nullptr;
    room_->voxels.bindStorage(1);
    room_->position.bindStorage(2);
    room_->look.bindStorage(3);
    if (coloured) {
        dust.colour->bindStorage(4);
        room_->colour.bindStorage(5);
    }
    passes_->tally.bindUniform(2);
    passes_->list(coloured).dispatchIndirect(passes_->tally, tallyGroupsAt);
    drawn_ = {.position = &room_->position,
              .look = &room_->look,
              .colour = coloured ? &room_->colour : nullptr,
              .tally = &passes_->tally,
              .bound = dust.bound,
              .colourOfAll = dust.colourOfAll};
}

const GpuPuffs& GpuOctree::drawn() const {
    return drawn_;
}

void GpuOctree::bindFrame() const {
    passes_->moment.bindUniform(0);
    passes_->state.bindUniform(1);
}

const gpu::Buffer& GpuOctree::voxels() const {
    return room_->voxels;
}

std::uint32_t GpuOctree::capacity() const {
    return room_ ? room_->capacity : 0;
}

GpuOctreeNumbers GpuOctree::readNumbers() const {
    StateValues state;
    passes_->state.read(std::span(&state, 1));
    GpuOctreeNumbers numbers;
    passes_->tally.read(std::span(&numbers.voxels, 1));
    numbers.lattice = {glm::dvec3(state.origin), state.origin.w, state.first.w};
    numbers.particles = state.counts.z;
    numbers.clipped = state.counts.x;
    numbers.notNumbers = state.maxima.w;
    numbers.maximumClipped = state.maxima.x;
    numbers.maximumVoxels = state.maxima.y;
    numbers.maximumDepth = static_cast<int>(state.maxima.z);
    return numbers;
}

std::vector<GpuVoxel> GpuOctree::readVoxels() const {
    std::vector<GpuVoxel> voxels(room_ ? readNumbers().voxels : 0);
    if (!voxels.empty()) room_->voxels.read(std::span(voxels));
    return voxels;
}

std::size_t GpuOctree::bytes() const {
    return passes_->bytes() + (room_ ? room_->bytes() : 0);
}

std::size_t GpuOctree::voxelBytes() const {
    return (room_ && room_->coloured ? 12 : 9) * wordBytes;
}

}  // namespace dustbench::octree
