#include "methods/octree_recursive/sorting_reducer.h"

#include <algorithm>
#include <array>

namespace dustbench::octree_recursive {

using namespace octree;
namespace {

/// A stable counting sort by seven bits of the location code.
void sortByDigit(const BrickVoxel* from, BrickVoxel* to, std::uint32_t count, int shift) {
    std::array<std::uint32_t, 128> next{};
    for (std::uint32_t i = 0; i < count; ++i) ++next[from[i].location >> shift & 127];
    std::uint32_t sum = 0;
    for (std::uint32_t& start : next) {
        const std::uint32_t here = start;
        start = sum;
        sum += here;
    }
    for (std::uint32_t i = 0; i < count; ++i) to[next[from[i].location >> shift & 127]++] = from[i];
}

}  // namespace

void SortingReducer::reduce(const BrickPartition& partition, const Brick& brick, const BrickVoxels& voxels) {
    BrickVoxel* const particles = voxels.voxels;
    std::uint32_t total = 0;
    partition.forEachParticle(brick, [&](std::uint64_t key) {
        particles[total++] = {partition.key().location(key), partition.key().particle(key)};
    });
    sortByDigit(particles, voxels.spare, total, 0);
    sortByDigit(voxels.spare, particles, total, 7);

    voxels.nodes.clear();
    std::uint32_t count = 0;
    for (std::uint32_t begin = 0; begin < total;) {
        const std::uint32_t location = particles[begin].location;
        std::uint32_t winner = particles[begin].particle;
        double mass = 0;
        std::uint32_t end = begin;
        for (; end < total && particles[end].location == location; ++end) {
            if (voxels.masses) mass += rule_.massSquareMetres(particles[end].particle);
            if (rule_.wins(particles[end].particle, winner)) winner = particles[end].particle;
        }
        voxels.nodes.setVoxel(location);
        if (voxels.masses) voxels.masses[count] = mass;
        particles[count++] = {location, winner};
        begin = end;
    }
    voxels.nodes.complete();
}

}  // namespace dustbench::octree_recursive
