#include "methods/kit/octree/voxel_cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "methods/contract/volume.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::octree {
namespace {

constexpr std::size_t cloudBlock = 4096;

/// A fading voxel is dropped when its optical depth falls below this: less than half a step of 8 bits.
constexpr float minimumOpticalDepth = 1.0f / 1024;
/// Frames are not exactly as long as intervals.
constexpr double dueEarlySeconds = 1e-6;

/// Appends voxel `i` of `from`, with the given mass.
void append(const VoxelCloud& from, std::size_t i, float mass, VoxelCloud& to) {
    to.place.push_back(from.place[i]);
    to.x.push_back(from.x[i]);
    to.y.push_back(from.y[i]);
    to.z.push_back(from.z[i]);
    to.edge.push_back(from.edge[i]);
    to.mass.push_back(mass);
    to.age.push_back(from.age[i]);
    if (!from.noise.empty()) to.noise.push_back(from.noise[i]);
    if (!from.coloured()) return;
    to.red.push_back(from.red[i]);
    to.green.push_back(from.green[i]);
    to.blue.push_back(from.blue[i]);
}

}  // namespace

VoxelCloud::VoxelCloud(MemoryLedger& ledger)
    : place(ledger.account("voxel list")),
      x(ledger.account("voxel list")),
      y(ledger.account("voxel list")),
      z(ledger.account("voxel list")),
      edge(ledger.account("voxel list")),
      mass(ledger.account("voxel list")),
      age(ledger.account("voxel list")),
      red(ledger.account("voxel list")),
      green(ledger.account("voxel list")),
      blue(ledger.account("voxel list")),
      noise(ledger.account("voxel list")) {}

void VoxelCloud::resize(std::size_t count, bool withColours) {
    place.resize(count);
    for (LedgerVector<float>* column : {&x, &y, &z, &edge, &mass, &age}) column->resize(count);
    for (LedgerVector<float>* column : {&red, &green, &blue}) column->resize(withColours ? count : 0);
}

void VoxelCloud::locate(std::size_t i) {
    const double finest = lattice.cellEdgeMetres(lattice.depth);
    const auto cells = static_cast<double>(1u << rise(i));
    const glm::dvec3 centre = lattice.origin + finest * (glm::dvec3(mortonCell(code(i))) + cells / 2);
    x[i] = static_cast<float>(centre.x);
    y[i] = static_cast<float>(centre.y);
    z[i] = static_cast<float>(centre.z);
    edge[i] = static_cast<float>(finest * cells);
}

void VoxelCloud::take(const Octree& tree, const Puffs& store, const VoxelRule& rule, const Lattice& treeLattice,
                      const draw::NoiseSettings& noiseOfPuffs) {
    lattice = treeLattice;
    const std::span<const CellEntry> voxels = tree.voxels();
    const std::span<const double> masses = tree.masses();
    resize(voxels.size(), !store.uniformColour);
    noise.resize(noiseOfPuffs.isOn() ? voxels.size() : 0);
    parallel::forEachBlock(voxels.size(), cloudBlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const std::uint32_t particle = voxels[i].index();
            place[i] = voxels[i].place();
            locate(i);
            mass[i] = static_cast<float>(masses.empty() ? rule.massSquareMetres(particle) : masses[i]);
            age[i] = store.age[particle];
            if (!noise.empty())
                noise[i] = draw::noiseOf(store.serial[particle], store.radius[particle],
                                         glm::vec3(x[i], y[i], z[i]) - store.position(particle), noiseOfPuffs);
            if (red.empty()) continue;
            red[i] = store.red[particle];
            green[i] = store.green[particle];
            blue[i] = store.blue[particle];
        }
    });
}

/// Moves the voxels to a world shifted by whole cells: the codes change, and with them the order.
void VoxelMix::moveTo(const Lattice& lattice, VoxelCloud& cloud) {
    if (cloud.lattice == lattice) return;
    const glm::ivec3 shift = cloud.lattice.firstCell() - lattice.firstCell();
    const auto cells = static_cast<int>(lattice.cellsPerEdge());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const glm::ivec3 cell = glm::ivec3(mortonCell(cloud.code(i))) + shift;
        const bool inside =
            glm::all(glm::greaterThanEqual(cell, glm::ivec3(0))) && glm::all(glm::lessThan(cell, glm::ivec3(cells)));
        const std::uint64_t level = cloud.place[i] & 15;
        cloud.place[i] = inside ? mortonCode(static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
                                             static_cast<std::uint32_t>(cell.z))
                                          << 4 |
                                      level
                                : std::numeric_limits<std::uint64_t>::max();
    }
    order_.resize(cloud.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::sort(order_, [&](std::uint32_t a, std::uint32_t b) { return cloud.place[a] < cloud.place[b]; });
    moved_.clear();
    for (const std::uint32_t i : order_)
        if (cloud.place[i] != std::numeric_limits<std::uint64_t>::max()) append(cloud, i, cloud.mass[i], moved_);
    std::swap(cloud, moved_);
    cloud.lattice = lattice;
}

void VoxelMix::mix(VoxelCloud& from, const VoxelCloud& to, float share, float dropBelow, VoxelCloud& mixed) {
    moveTo(to.lattice, from);
    mixed.clear();
    mixed.lattice = to.lattice;
    std::size_t old = 0, now = 0;
    while (old < from.size() || now < to.size()) {
        const bool fades = now == to.size() || (old < from.size() && from.place[old] < to.place[now]);
        const bool appears = !fades && (old == from.size() || to.place[now] < from.place[old]);
        if (fades) {
            const float mass = from.mass[old] * (1 - share);
            if (mass >= dropBelow * from.edge[old] * from.edge[old]) append(from, old, mass, mixed);
            ++old;
            continue;
        }
        const float before = appears ? 0 : from.mass[old];
        append(to, now, before + share * (to.mass[now] - before), mixed);
        old += appears ? 0 : 1;
        ++now;
    }
}

CrossFade::CrossFade(MemoryLedger& ledger, double timeConstantSeconds)
    : timeConstantSeconds_(timeConstantSeconds), shown_(ledger), next_(ledger), mix_(ledger) {}

const VoxelCloud& CrossFade::follow(const VoxelCloud& target, double stepSeconds) {
    const double share = first_ ? 1 : -std::expm1(-stepSeconds / timeConstantSeconds_);
    first_ = false;
    mix_.mix(shown_, target, static_cast<float>(share), minimumOpticalDepth, next_);
    std::swap(shown_, next_);
    return shown_;
}

KeptVoxels::KeptVoxels(MemoryLedger& ledger, double keepSeconds)
    : keepSeconds_(keepSeconds), before_(ledger), last_(ledger), between_(ledger), mix_(ledger) {}

bool KeptVoxels::advance(double stepSeconds) {
    sinceSeconds_ += stepSeconds;
    intervalSeconds_ = stepSeconds * std::ceil((keepSeconds_ - dueEarlySeconds) / stepSeconds);
    return trees_ == 0 || sinceSeconds_ + dueEarlySeconds >= keepSeconds_;
}

void KeptVoxels::take(VoxelCloud& built) {
    std::swap(before_, last_);
    std::swap(last_, built);
    sinceSeconds_ = 0;
    trees_ = std::min(trees_ + 1, 2);
}

const VoxelCloud& KeptVoxels::between() {
    if (trees_ < 2) return last_;
    mix_.mix(before_, last_, static_cast<float>(std::min(sinceSeconds_ / intervalSeconds_, 1.0)), 0, between_);
    return between_;
}

}  // namespace dustbench::octree
