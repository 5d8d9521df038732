// Benchmarks voxelising and filling of the bunny if data/shapes/fetch_bunny.py has fetched it, otherwise of the rock.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/meshes/mesh_file.h"
#include "methods/voxel_shape/voxels/slice_pass.h"
#include "methods/voxel_shape/voxels/solid_fill.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

const scene::Mesh& model(benchmark::State& state) {
    static const auto bunny = files::dataFolder() / "shapes" / "meshes" / "bunny.ply";
    static const bool there = std::filesystem::exists(bunny);
    static const scene::Mesh mesh =
        meshes::readMesh(there ? bunny : files::dataFolder() / "scenes" / "meshes" / "rock.obj", glm::vec3(1));
    state.SetLabel((there ? "bunny, " : "rock, ") + std::to_string(mesh.indices.size() / 3) + " triangles");
    return mesh;
}

void surface(benchmark::State& state) {
    const scene::Mesh& mesh = model(state);
    const Lattice lattice = latticeAround(mesh, static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(surfaceVoxels(mesh, lattice).marked.data());
}
void slices(benchmark::State& state) {
    const scene::Mesh& mesh = model(state);
    const Lattice lattice = latticeAround(mesh, static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(sliceVoxels(mesh, lattice).marked.data());
}
void slicesOnTheGpu(benchmark::State& state) {
    const scene::Mesh& mesh = model(state);
    gpu::Device device;
    const Lattice lattice = latticeAround(mesh, static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(slicePass(device, mesh, lattice).marked.data());
}
void solid(benchmark::State& state) {
    const scene::Mesh& mesh = model(state);
    const Lattice lattice = latticeAround(mesh, static_cast<int>(state.range(0)));
    for (auto _ : state) {
        MarkedVoxels voxels = surfaceVoxels(mesh, lattice);
        fillSolid(voxels, mesh);
        benchmark::DoNotOptimize(voxels.marked.data());
    }
}
/// A mesh of millions of triangles.
void fineSphere(benchmark::State& state) {
    const scene::Mesh mesh = sphereMesh(1, static_cast<int>(state.range(1)));
    state.SetLabel(std::to_string(mesh.indices.size() / 3) + " triangles");
    const Lattice lattice = latticeAround(mesh, static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(surfaceVoxels(mesh, lattice).marked.data());
}
BENCHMARK(surface)->Arg(50)->Arg(100)->Arg(256)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(slices)->Arg(50)->Arg(100)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(slicesOnTheGpu)->Arg(50)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(solid)->Arg(50)->Arg(256)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(fineSphere)->Args({50, 700})->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dustbench::voxel_shape
