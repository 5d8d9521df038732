// The same grids and pictures with NanoVDB: its TreeMarcher skips empty space, its trilinear sampler evaluates the
// steps.
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/HDDA.h>
#include <nanovdb/util/Ray.h>
#include <nanovdb/util/SampleFromVoxels.h>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/raycast/raycast_bench_scene.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {
namespace {

using Ray = nanovdb::Ray<float>;

/// Cells with density and their neighbours, so that the sampler's reach is not skipped.
nanovdb::GridHandle<> treeOf(const TestGrid& grid) {
    nanovdb::GridBuilder<float> builder(0.0f);
    auto accessor = builder.getAccessor();
    const auto densityAt = [&](const glm::ivec3& cell) {
        return grid.density[static_cast<std::size_t>(cell.x + grid.cells.x * (cell.y + grid.cells.y * cell.z))];
    };
    for (int z = 0; z < grid.cells.z; ++z)
        for (int y = 0; y < grid.cells.y; ++y)
            for (int x = 0; x < grid.cells.x; ++x) {
                const glm::ivec3 cell(x, y, z);
                bool near = false;
                for (int n = 0; n < 27 && !near; ++n) {
                    const glm::ivec3 there = cell + glm::ivec3(n % 3, n / 3 % 3, n / 9) - 1;
                    near = glm::clamp(there, glm::ivec3(0), grid.cells - 1) == there && densityAt(there) > 0;
                }
                if (near) accessor.setValue(nanovdb::Coord(x, y, z), densityAt(cell));
            }
    return builder.getHandle<>();
}

template <typename Accessor, typename Sampler>
float alphaAlong(const PixelRays& rays, const RaycastSettings& settings, float extinction, int x, int y,
                 Accessor& accessor, const Sampler& sampler) {
    const glm::vec3 ray = glm::normalize(rays.corner + (static_cast<float>(x) + 0.5f) * rays.right +
                                         (static_cast<float>(y) + 0.5f) * rays.up);
    const glm::vec3 eye = rays.eye - 0.5f;
    const Ray index({eye.x, eye.y, eye.z}, {ray.x, ray.y, ray.z}, 0.0f);
    nanovdb::TreeMarcher<nanovdb::LeafNode<float>, Ray, Accessor> marcher(accessor);
    if (!marcher.init(index)) return 0;
    const auto step = static_cast<float>(settings.stepCells);
    const float shift = jitterOf(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) * step;
    const float opaque = opaqueDepth(settings);
    const nanovdb::LeafNode<float>* leaf = nullptr;
    float depth = 0, enter = 0, leave = 0;
    while (depth <= opaque && marcher.step(&leaf, enter, leave)) {
        // The steps whose middle lies in this leaf.
        const auto middleOf = [&](float k) { return (k + 0.5f) * step + shift; };
        for (float k = std::ceil((enter - shift) / step - 0.5f); middleOf(k) < leave && depth <= opaque; k += 1)
            depth += sampler(index(middleOf(k))) * step * extinction;
    }
    return -std::expm1(-depth);
}

void nanoVdb(benchmark::State& state, Shown shown) {
    const TestGrid& grid = benchGrid(shown);
    const nanovdb::GridHandle<> handle = treeOf(grid);
    const nanovdb::NanoGrid<float>& tree = *handle.grid<float>();
    const scene::View& view = benchCanvas(shown).view;
    const RaycastSettings settings = benchSettings(Backend::cpu, true);
    const auto extinction = static_cast<float>(settings.extinctionPerMetre * grid.spacingMetres);
    const PixelRays rays(grid.shown(), view);
    std::vector<float> alphas(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
    const auto marchAll = [&] {
        parallel::forEachBlock(static_cast<std::size_t>(view.height), 4, [&](std::size_t first, std::size_t count) {
            auto accessor = tree.getAccessor();
            const auto sampler = nanovdb::createSampler<1>(accessor);
            for (std::size_t y = first; y < first + count; ++y)
                for (int x = 0; x < view.width; ++x)
                    alphas[y * static_cast<std::size_t>(view.width) + static_cast<std::size_t>(x)] =
                        alphaAlong(rays, settings, extinction, x, static_cast<int>(y), accessor, sampler);
        });
    };
    marchAll();
    // Pictures that are read back begin with the top row.
    const auto width = static_cast<std::size_t>(view.width), last = static_cast<std::size_t>(view.height) - 1;
    verifyPicture(
        state, [&](std::size_t i) { return alphas[(last - i / width) * width + i % width]; }, shown);
    for (auto _ : state) marchAll();
}

BENCHMARK_CAPTURE(nanoVdb, plume, Shown::plume)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(nanoVdb, trail, Shown::trail)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace
}  // namespace dustbench::raycast
