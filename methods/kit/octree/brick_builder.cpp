#include "methods/kit/octree/brick_builder.h"

#include <algorithm>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::octree {

BrickAssembly::BrickAssembly(MemoryLedger& ledger)
    : found_(ledger.account("octree bricks")),
      spare_(ledger.account("octree bricks")),
      masses_(ledger.account("octree bricks")),
      upperMasses_(ledger.account("octree bricks")),
      nodes_(ledger.account("octree bricks")),
      places_(ledger.account("octree bricks")),
      upperPlaces_(ledger.account("octree bricks")) {}

void BrickAssembly::hold(const BrickPartition& partition, bool withMasses, bool withSpare) {
    withMasses_ = withMasses;
    withSpare_ = withSpare;
    if (withSpare) spare_.hold(partition.size());
    found_.hold(partition.size());
    if (withMasses) masses_.hold(partition.size());
    nodes_.hold(partition.bricks().size());
}

/// Sorts the few upper entries by place (equal places stay in store order) and reduces each place to its winner.
std::size_t BrickAssembly::reduceUpper(std::span<CellEntry> upper, const VoxelRule& rule) {
    std::ranges::sort(upper, [](CellEntry a, CellEntry b) {
        return a.place() != b.place() ? a.place() < b.place() : a.index() < b.index();
    });
    double* const masses = withMasses_ ? upperMasses_.hold(upper.size()) : nullptr;
    std::size_t count = 0;
    for (std::size_t begin = 0; begin < upper.size();) {
        const CellEntry first = upper[begin];
        std::uint32_t winner = first.index();
        double mass = 0;
        std::size_t end = begin;
        for (; end < upper.size() && upper[end].place() == first.place(); ++end) {
            if (masses) mass += rule.massSquareMetres(upper[end].index());
            if (rule.wins(upper[end].index(), winner)) winner = upper[end].index();
        }
        if (masses) masses[count] = mass;
        upper[count++] = CellEntry(first.voxelCode(), first.rise(), winner);
        begin = end;
    }
    return count;
}

/// Numbers both lists in one pre-order: a voxel above a brick precedes all bricks inside it.
void BrickAssembly::numberVoxels(std::span<const Brick> bricks, std::span<const CellEntry> upper) {
    Place* const places = places_.hold(bricks.size());
    std::uint32_t* const upperPlaces = upperPlaces_.hold(upper.size());
    std::size_t above = 0;
    voxels_ = 0;
    blocks_ = 1;  // the root's block
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        for (; above < upper.size() && upper[above].code() <= bricks[i].code; ++above) upperPlaces[above] = voxels_++;
        places[i] = {voxels_, blocks_};
        voxels_ += nodes_.data()[i].voxelCount();
        blocks_ += nodes_.data()[i].blockCount();
    }
    for (; above < upper.size(); ++above) upperPlaces[above] = voxels_++;
}

void BrickAssembly::writeBricks(std::span<const Brick> bricks, Octree& tree) {
    CellEntry* const voxels = tree.mutableVoxels();
    double* const masses = tree.mutableMasses();
    NodeBlock* const blocks = tree.mutableBlocks();
    const bool rootIsBrick = tree.depth() == brickRise;
    const std::size_t atOnce = std::clamp<std::size_t>(bricks.size() / 64, 1, 64);
    parallel::forEachBlock(bricks.size(), atOnce, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const BrickNodes& nodes = nodes_.data()[i];
            const Place place = places_.data()[i];
            if (rootIsBrick)
                nodes.write(blocks, 0, 1, 0);
            else
                nodes.write(blocks, place.firstBlock, place.firstBlock + 1, place.firstVoxel);
            std::copy_n(found_.data() + bricks[i].first, nodes.voxelCount(), voxels + place.firstVoxel);
            if (withMasses_)
                std::copy_n(masses_.data() + bricks[i].first, nodes.voxelCount(), masses + place.firstVoxel);
        }
    });
}

/// Adds the nodes from the root down to the bricks and to the voxels above them.
void BrickAssembly::addTop(std::span<const Brick> bricks, std::span<const CellEntry> upper, Octree& tree) {
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        const BrickNodes& nodes = nodes_.data()[i];
        NodeSlot& slot = tree.makeNode(bricks[i].code, brickRise);
        if (nodes.blockCount() > 0) slot.children = places_.data()[i].firstBlock;
        if (nodes.isVoxel()) slot.voxel = places_.data()[i].firstVoxel + 1;
    }
    for (std::size_t i = 0; i < upper.size(); ++i)
        tree.makeNode(upper[i].code(), upper[i].rise()).voxel = upperPlaces_.data()[i] + 1;
}

void BrickAssembly::assemble(BrickPartition& partition, const VoxelRule& rule, int depth, Octree& tree) {
    const std::span<const Brick> bricks = partition.bricks();
    const std::span<const CellEntry> upper = partition.upper().first(reduceUpper(partition.upper(), rule));
    numberVoxels(bricks, upper);
    tree.clear(depth);
    tree.setVoxels(voxels_, withMasses_);
    // If a brick covers the whole world, its own block is the root's.
    tree.setBlocks(depth == brickRise ? std::max(blocks_ - 1, 1u) : blocks_);
    writeBricks(bricks, tree);
    for (std::size_t i = 0; i < upper.size(); ++i) {
        tree.mutableVoxels()[upperPlaces_.data()[i]] = upper[i];
        if (withMasses_) tree.mutableMasses()[upperPlaces_.data()[i]] = upperMasses_.data()[i];
    }
    if (depth > brickRise) addTop(bricks, upper, tree);
}

}  // namespace dustbench::octree
