#include "methods/kit/octree/gpu/gpu_octree_dust.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/contract/volume.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::octree {
namespace {

constexpr std::size_t puffsPerBlock = 16'384, leastPuffs = 4096;

/// Fills the first `count` rows of `rowWords` words: `row(i, words)` writes one. A larger buffer replaces one that is
/// too small.
template <typename Word, typename Row>
void fillRows(gpu::Device& device, gpu::Buffer& buffer, std::size_t count, std::size_t rowWords, const Row& row) {
    const std::size_t bytes = count * rowWords * sizeof(Word);
    if (bytes > buffer.bytes() || buffer.bytes() == 0)
        buffer = gpu::Buffer(device, "uploaded puffs",
                             std::max({bytes, 2 * buffer.bytes(), leastPuffs * rowWords * sizeof(Word)}));
    if (count == 0) return;
    Word* const words = static_cast<Word*>(buffer.mapForWriting(bytes));
    parallel::forEachBlock(count, puffsPerBlock, [&](std::size_t first, std::size_t length) {
        for (std::size_t i = first; i < first + length; ++i) row(i, words + i * rowWords);
    });
    buffer.unmap();
}

void requireOnGpu(bool allowed, const char* parameter, const char* got, const char* expected) {
    if (!allowed)
        throw InputError(std::string("parameter ") + parameter + ": got " + got +
                         " with layout=gpu, allowed: " + expected);
}

}  // namespace

const GpuPuffs& PuffUpload::upload(const Puffs& dust) {
    const std::size_t count = dust.size();
    fillRows<float>(device_, position_, count, 3,
                    [&](std::size_t i, float* row) { row[0] = dust.x[i], row[1] = dust.y[i], row[2] = dust.z[i]; });
    fillRows<float>(device_, life_, count, 2,
                    [&](std::size_t i, float* row) { row[0] = dust.age[i], row[1] = dust.lifetime[i]; });
    fillRows<float>(device_, look_, count, 2,
                    [&](std::size_t i, float* row) { row[0] = dust.radius[i], row[1] = dust.opacity[i]; });
    fillRows<std::uint32_t>(device_, serial_, count, 2, [&](std::size_t i, std::uint32_t* row) {
        row[0] = static_cast<std::uint32_t>(dust.serial[i]), row[1] = static_cast<std::uint32_t>(dust.serial[i] >> 32);
    });
    if (!dust.uniformColour)
        fillRows<float>(device_, colour_, count, 3, [&](std::size_t i, float* row) {
            row[0] = dust.red[i], row[1] = dust.green[i], row[2] = dust.blue[i];
        });
    if (tally_.bytes() == 0) tally_ = gpu::Buffer(device_, "uploaded puffs", 4 * sizeof(std::uint32_t));
    const auto puffs = static_cast<std::uint32_t>(count);
    const std::array<std::uint32_t, 4> tally{puffs, (puffs + 255) / 256, 1, 1};
    tally_.write(std::span<const std::uint32_t>(tally));
    puffs_ = {.position = &position_,
              .life = &life_,
              .look = &look_,
              .serial = &serial_,
              .colour = dust.uniformColour ? nullptr : &colour_,
              .tally = &tally_,
              .bound = puffs,
              .colourOfAll = dust.colourOfAll};
    return puffs_;
}

std::size_t PuffUpload::bytes() const {
    return position_.bytes() + life_.bytes() + look_.bytes() + serial_.bytes() + colour_.bytes() + tally_.bytes();
}

bool isBuiltOnGpu(const ParameterValues& values) {
    return values.choice("layout") == "gpu";
}

GpuOctreeDust::GpuOctreeDust(const DustSettings& settings) : settings_(settings) {
    requireOnGpu(settings.sort != draw::SortKind::quicksort, "sort", "quicksort", "radix|none");
    requireOnGpu(!settings.crossFade, "crossfade", "on", "off");
    requireOnGpu(settings.keepSeconds == 0, "keep_time", "more than 0", "0");
    requireOnGpu(!settings.noise.isOn(), "noise", "more than 0", "0");
}

void GpuOctreeDust::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    device_ = &device;
    tree_.emplace(device);
    const bool isMarched = settings_.render == Render::raycast;
    if (!isMarched && settings_.sort != draw::SortKind::none) order_.emplace(device);
    if (isMarched)
        march_.emplace(device);
    else if (settings_.render == Render::cubes)
        cubes_.emplace(device);
    else
        billboards_.emplace(device, draw::BillboardStyle{.plainAlpha = settings_.render == Render::circles});
}

void GpuOctreeDust::update(const Frame& frame) {
    const GpuPuffs* dust = frame.gpuDust;
    if (!dust) {
        const auto timing = frame.clock.measure(Stage::upload);
        if (!upload_) upload_.emplace(*device_);
        dust = &upload_->upload(frame.dust);
    }
    tree_->build(*dust, settings_, frame.state.vehicle.position, frame.index <= 0, frame.clock);
    if (march_) {
        const auto detail = frame.clock.measureDetail("nodes");
        march_->take(*tree_);
        return;
    }
    const gpu::Buffer* order = nullptr;
    if (order_) {
        const auto timing = frame.clock.measure(Stage::sort);
        order = &order_->farToNear(tree_->drawn(), glm::vec3(frame.view.camera.eye));
    }
    const auto timing = frame.clock.measure(Stage::upload);
    if (cubes_) cubes_->gather(tree_->drawn(), order);
    if (billboards_) billboards_->gather(tree_->drawn(), order);
}

void GpuOctreeDust::draw(const Frame& frame, gpu::Layer& layer) {
    if (billboards_) billboards_->draw(frame.view, frame.dust.colourOfAll, layer);
    if (cubes_) cubes_->draw(frame.view, frame.dust.colourOfAll, layer);
    if (march_) march_->draw(*tree_, frame.view, frame.dust.colourOfAll, layer);
}

const gpu::Buffer* GpuOctreeDust::primitiveCount() const {
    return tree_->drawn().tally;
}

void GpuOctreeDust::volume(const Frame& frame, VolumeVisitor& visitor) const {
    const Lattice lattice = tree_->readNumbers().lattice;
    std::vector<OctreeVoxel> voxels;
    for (const GpuVoxel& voxel : tree_->readVoxels()) {
        const glm::uvec3 cell = mortonCell(voxel.code()) >> static_cast<unsigned>(voxel.rise());
        const int level = lattice.depth - voxel.rise();
        const auto edge = static_cast<float>(lattice.cellEdgeMetres(level));
        voxels.push_back({cell.x, cell.y, cell.z, level, voxel.massSquareMetres / (edge * edge) / edge,
                          frame.dust.age[voxel.particle]});
    }
    visitor.octree({lattice.origin, lattice.edgeMetres, lattice.depth, voxels});
}

void GpuOctreeDust::report(const Frame& frame, Facts& facts) const {
    const GpuOctreeNumbers numbers = tree_->readNumbers();
    if (numbers.notNumbers > 0)
        throw SimulationError("octree: the positions of " + std::to_string(numbers.notNumbers) +
                              " particles, summed over all frames, are not numbers");
    if (march_) {
        const std::uint32_t blocks = march_->readBlocks(numbers.voxels);
        if (blocks > march_->blockLimit())
            throw InputError("render raycast: got an octree of " + std::to_string(blocks) + " blocks, allowed: up to " +
                             std::to_string(march_->blockLimit()));
    }
    facts.set("clipped", static_cast<std::int64_t>(numbers.maximumClipped));
    facts.set("structure_bytes", static_cast<std::int64_t>(numbers.maximumVoxels * tree_->voxelBytes()));
    if (settings_.worldGrows)
        facts.set("world_edge_max", std::ldexp(settings_.worldEdgeMetres, numbers.maximumDepth - settings_.tree.depth));
    if (!facts.wants("mass_kept")) return;
    std::vector<float> masses;
    for (const GpuVoxel& voxel : tree_->readVoxels()) masses.push_back(voxel.massSquareMetres);
    reportMass({frame.dust, numbers.lattice, masses, masses}, settings_, facts);
}

MemoryReport GpuOctreeDust::memory() const {
    MemoryReport report;
    if (tree_) report.push_back({"octree", 0, tree_->bytes()});
    if (upload_) report.push_back({"uploaded puffs", 0, upload_->bytes()});
    if (order_) report.push_back({"depth order", 0, order_->bytes()});
    if (billboards_) report.push_back({"billboards", 0, billboards_->gpuBytes()});
    if (cubes_) report.push_back({"cubes", 0, cubes_->gpuBytes()});
    if (march_) report.push_back({"octree march", 0, march_->bytes()});
    return report;
}

}  // namespace dustbench::octree
