#include "methods/octree_recursive/sorting_reducer.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace dustbench::octree_recursive {

using namespace octree;
namespace {

/// A stable counting sort by seven bits of the place in the brick, which is stored in the entry's code.
void sortByDigit(const CellEntry* from, CellEntry* to, std::uint32_t count, int shift) {
    std::array<std::uint32_t, 128> next{};
    for (std::uint32_t i = 0; i < count; ++i) ++next[from[i].code() >> shift & 127];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0u);
    for (std::uint32_t i = 0; i < count; ++i) to[next[from[i].code() >> shift & 127]++] = from[i];
}

}  // namespace

void SortingReducer::reduce(const BrickPartition& partition, const Brick& brick, const BrickVoxels& voxels) {
    CellEntry* const particles = voxels.voxels;
    std::uint32_t total = 0;
    partition.forEachParticle(brick, [&](std::uint64_t key) {
        particles[total++] = CellEntry(partition.key().place(key), 0, partition.key().particle(key));
    });
    sortByDigit(particles, voxels.spare, total, 0);
    sortByDigit(voxels.spare, particles, total, 7);

    PlaceBits taken{};
    std::uint32_t count = 0;
    for (std::uint32_t begin = 0; begin < total;) {
        const auto place = static_cast<std::uint32_t>(particles[begin].code());
        std::uint32_t winner = particles[begin].index();
        double mass = 0;
        std::uint32_t end = begin;
        for (; end < total && particles[end].code() == place; ++end) {
            if (voxels.masses) mass += rule_.massSquareMetres(particles[end].index());
            if (rule_.wins(particles[end].index(), winner)) winner = particles[end].index();
        }
        taken[place / 64] |= std::uint64_t{1} << place % 64;
        if (voxels.masses) voxels.masses[count] = mass;
        particles[count++] = voxelAt(brick, place, winner);
        begin = end;
    }
    voxels.nodes.set(taken);
}

}  // namespace dustbench::octree_recursive
