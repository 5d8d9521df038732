#include "methods/kit/octree/voxel_cloud.h"

#include "methods/contract/volume.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::octree {
namespace {

constexpr std::size_t cloudBlock = 4096;

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

}  // namespace dustbench::octree
