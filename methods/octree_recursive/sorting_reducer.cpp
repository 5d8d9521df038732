#include "methods/octree_recursive/sorting_reducer.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace dustbench::octree_recursive {

using namespace octree;
namespace {

/// A stable counting sort by eight bits of the places inside one brick.
void sortByDigit(const CellEntry* from, CellEntry* to, std::uint32_t count, int shift) {
    const auto digitOf = [shift](CellEntry entry) { return static_cast<std::uint8_t>(entry.place() >> shift); };
    std::array<std::uint32_t, 256> next{};
    for (std::uint32_t i = 0; i < count; ++i) ++next[digitOf(from[i])];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0u);
    for (std::uint32_t i = 0; i < count; ++i) to[next[digitOf(from[i])]++] = from[i];
}

}  // namespace

void SortingReducer::reduce(const BrickPartition& partition, const Brick& brick, const BrickVoxels& voxels) {
    CellEntry* const particles = voxels.voxels;
    std::uint32_t total = 0;
    partition.forEachParticle(brick, [&](std::uint64_t key) {
        particles[total++] = voxelAt(brick, partition.key().place(key), partition.key().particle(key));
    });
    sortByDigit(particles, voxels.spare, total, 0);
    sortByDigit(voxels.spare, particles, total, 8);

    voxels.nodes.clear();
    std::uint32_t count = 0;
    for (std::uint32_t begin = 0; begin < total;) {
        const CellEntry first = particles[begin];
        std::uint32_t winner = first.index();
        double mass = 0;
        std::uint32_t end = begin;
        for (; end < total && particles[end].place() == first.place(); ++end) {
            if (voxels.masses) mass += rule_.massSquareMetres(particles[end].index());
            if (rule_.wins(particles[end].index(), winner)) winner = particles[end].index();
        }
        const auto local = static_cast<std::uint32_t>(first.code() % finestInBrick);
        voxels.nodes.setVoxel(placeInBrick(local, static_cast<std::uint32_t>(first.rise())));
        if (voxels.masses) voxels.masses[count] = mass;
        particles[count++] = CellEntry(first.code(), first.rise(), winner);
        begin = end;
    }
    voxels.nodes.complete();
}

}  // namespace dustbench::octree_recursive
