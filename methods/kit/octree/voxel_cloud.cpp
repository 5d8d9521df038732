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

/// A voxel without a target is dropped when its optical depth falls below this: less than half a step of 8 bits.
constexpr float minimumOpticalDepth = 1.0f / 1024;

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

CrossFade::CrossFade(MemoryLedger& ledger, double timeConstantSeconds)
    : timeConstantSeconds_(timeConstantSeconds), shown_(ledger), next_(ledger), order_(ledger.account("voxel list")) {}

/// Appends voxel `i` of `from`, with the given mass, to `next_`.
void CrossFade::append(const VoxelCloud& from, std::size_t i, float mass) {
    next_.place.push_back(from.place[i]);
    next_.x.push_back(from.x[i]);
    next_.y.push_back(from.y[i]);
    next_.z.push_back(from.z[i]);
    next_.edge.push_back(from.edge[i]);
    next_.mass.push_back(mass);
    next_.age.push_back(from.age[i]);
    if (!from.noise.empty()) next_.noise.push_back(from.noise[i]);
    if (!from.coloured()) return;
    next_.red.push_back(from.red[i]);
    next_.green.push_back(from.green[i]);
    next_.blue.push_back(from.blue[i]);
}

/// Moves the voxels to a world shifted by whole cells: the codes change, and with them the order.
void CrossFade::moveTo(const Lattice& lattice) {
    if (shown_.lattice == lattice) return;
    const glm::ivec3 shift = shown_.lattice.firstCell() - lattice.firstCell();
    const auto cells = static_cast<int>(lattice.cellsPerEdge());
    for (std::size_t i = 0; i < shown_.size(); ++i) {
        const glm::ivec3 cell = glm::ivec3(mortonCell(shown_.code(i))) + shift;
        const bool inside =
            glm::all(glm::greaterThanEqual(cell, glm::ivec3(0))) && glm::all(glm::lessThan(cell, glm::ivec3(cells)));
        const std::uint64_t level = shown_.place[i] & 15;
        shown_.place[i] = inside ? mortonCode(static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
                                              static_cast<std::uint32_t>(cell.z))
                                           << 4 |
                                       level
                                 : std::numeric_limits<std::uint64_t>::max();
    }
    order_.resize(shown_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::sort(order_, [this](std::uint32_t a, std::uint32_t b) { return shown_.place[a] < shown_.place[b]; });
    next_.clear();
    for (const std::uint32_t i : order_)
        if (shown_.place[i] != std::numeric_limits<std::uint64_t>::max()) append(shown_, i, shown_.mass[i]);
    std::swap(shown_, next_);
    shown_.lattice = lattice;
}

const VoxelCloud& CrossFade::follow(const VoxelCloud& target, double stepSeconds) {
    next_.lattice = target.lattice;
    if (first_) {
        first_ = false;
        next_.clear();
        for (std::size_t i = 0; i < target.size(); ++i) append(target, i, target.mass[i]);
        std::swap(shown_, next_);
        return shown_;
    }
    moveTo(target.lattice);
    next_.clear();
    next_.lattice = target.lattice;
    const auto step = static_cast<float>(-std::expm1(-stepSeconds / timeConstantSeconds_));
    std::size_t old = 0, now = 0;
    while (old < shown_.size() || now < target.size()) {
        const bool fades = now == target.size() || (old < shown_.size() && shown_.place[old] < target.place[now]);
        const bool appears = !fades && (old == shown_.size() || target.place[now] < shown_.place[old]);
        if (fades) {
            const float mass = shown_.mass[old] * (1 - step);
            if (mass >= minimumOpticalDepth * shown_.edge[old] * shown_.edge[old]) append(shown_, old, mass);
            ++old;
            continue;
        }
        const float before = appears ? 0 : shown_.mass[old];
        append(target, now, before + step * (target.mass[now] - before));
        old += appears ? 0 : 1;
        ++now;
    }
    std::swap(shown_, next_);
    return shown_;
}

}  // namespace dustbench::octree
