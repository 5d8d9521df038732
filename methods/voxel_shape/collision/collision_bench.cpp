// Benchmarks all three steps of collision for 40,000 particles around the surface of the bunny, subdivided twice.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/meshes/mesh_file.h"
#include "methods/voxel_shape/collision/shape_collision.h"
#include "methods/voxel_shape/particles/shape_system.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"

namespace dustbench::voxel_shape {
namespace {

/// Splits every triangle into four.
scene::Mesh subdivided(const scene::Mesh& mesh) {
    scene::Mesh finer;
    finer.positions = mesh.positions;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [found, isNew] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(finer.positions.size()));
        if (isNew) finer.positions.push_back((mesh.positions[a] + mesh.positions[b]) / 2.0f);
        return found->second;
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const std::uint32_t index : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca}) finer.indices.push_back(index);
    }
    return finer;
}

void collision(benchmark::State& state) {
    const auto bunny = files::dataFolder() / "shapes" / "meshes" / "bunny.ply";
    const bool there = std::filesystem::exists(bunny);
    scene::Mesh mesh = meshes::readMesh(there ? bunny : bunny.parent_path() / "hare.ply", glm::vec3(1));
    // The bunny of the npm package has 3,674 triangles; subdivided, 58,784.
    mesh = subdivided(subdivided(mesh));
    scene::Scene scene;
    scene.solids.push_back({"bunny", std::make_shared<scene::Mesh>(mesh)});
    scene.solidPoses.push_back({});
    state.SetLabel((there ? "bunny, " : "hare, ") + std::to_string(mesh.indices.size() / 3) + " triangles");

    // The shape is the bunny too, slightly displaced, so that its voxels and particles are at the solid's surface.
    const Lattice lattice = latticeAround(mesh, 50);
    MemoryLedger ledger;
    ShapeSystem system(ledger, surfaceVoxels(mesh, lattice), Voxel(), 1);
    system.grid().shareOut(40'000);
    Pose pose;
    pose.position = glm::vec3(0.5f, 0.3f, 0.2f) * lattice.edgeMetres;
    Motion motion;
    motion.birthSpeed = 4 * lattice.edgeMetres;
    system.step(pose, motion, 1.0f / 60);
    ShapeCollision collision(scene, lattice.edgeMetres, {});
    collision.moveTo({}, 1.0 / 60);
    std::size_t hits = 0;
    for (auto _ : state) {
        collision.switchVoxels(system.grid(), pose);
        hits += collision.stopParticles(system.particles(), 1.0f / 60);
    }
    state.counters["particles"] = static_cast<double>(system.particles().size());
    state.counters["voxels_off"] = static_cast<double>(collision.switchedOff());
    state.counters["hits_first"] = static_cast<double>(hits);
}
BENCHMARK(collision)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dustbench::voxel_shape
