#include "methods/kit/octree/gpu/gpu_octree_dust.h"

#include <cmath>
#include <string>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/contract/volume.h"

namespace dustbench::octree {
namespace {

void requireOnGpu(bool allowed, const char* parameter, const char* got, const char* expected) {
    if (!allowed)
        throw InputError(std::string("parameter ") + parameter + ": got " + got +
                         " with layout=gpu, allowed: " + expected);
}

}  // namespace

bool isBuiltOnGpu(const ParameterValues& values) {
    return values.choice("layout") == "gpu";
}

GpuOctreeDust::GpuOctreeDust(const DustSettings& settings) : settings_(settings) {
    requireOnGpu(settings.sort != draw::SortKind::quicksort, "sort", "quicksort", "radix|none");
    requireOnGpu(!settings.crossFade, "crossfade", "on", "off");
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
