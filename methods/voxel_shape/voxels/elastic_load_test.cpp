#include "methods/voxel_shape/voxels/elastic_load.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::voxel_shape {
namespace {

/// A bar of whole voxels along x, from the origin.
VoxelGrid bar(MemoryLedger& ledger, const glm::ivec3& counts, float edgeMetres) {
    MarkedVoxels marked(Lattice{counts, glm::vec3(0), edgeMetres});
    std::ranges::fill(marked.marked, std::uint8_t{1});
    return {ledger, marked, Voxel()};
}

/// Held at the layer x = 0, loaded at the last one.
ElasticLoad pullAtTheEnd(const VoxelGrid& grid, const glm::vec3& newtons) {
    const glm::vec3 end = grid.lattice().maximumCorner();
    const float edge = grid.lattice().edgeMetres;
    return {.where = "bar.toml:3: ",
            .held = {glm::vec3(-1), {edge, end.y, end.z}},
            .loaded = {{end.x - edge, -1, -1}, end},
            .newtons = newtons};
}

double stressAt(const std::vector<double>& stresses, const VoxelGrid& grid, const glm::ivec3& cell) {
    const auto found = std::ranges::find(grid.active(), grid.lattice().index(cell));
    return stresses[static_cast<std::size_t>(found - grid.active().begin())];
}

/// σ = F/A away from the ends (Saint-Venant), whatever Poisson's ratio.
TEST(ElasticLoad, PullsABarWithTheForceByItsCrossSection) {
    MemoryLedger ledger;
    const VoxelGrid grid = bar(ledger, {24, 4, 3}, 0.05f);
    for (const double poisson : {0.0, 0.3, 0.45}) {
        ElasticLoad load = pullAtTheEnd(grid, {60, 0, 0});
        load.poisson = poisson;
        const std::vector<double> stresses = stressUnder(load, grid);
        for (int y = 0; y < 4; ++y)
            for (int z = 0; z < 3; ++z)
                EXPECT_NEAR(stressAt(stresses, grid, {12, y, z}), 60 / (0.2 * 0.15), 0.002 * 2000) << poisson;
    }
}

/// σ = M·y/I in a cantilever: linear over its depth, and falling to the loaded end. The error falls with the voxels'
/// size.
TEST(ElasticLoad, BendsABeamByItsMoment) {
    MemoryLedger ledger;
    std::vector<double> errors;
    for (const int depth : {4, 8}) {
        const float edge = 0.4f / static_cast<float>(depth);
        const VoxelGrid grid = bar(ledger, {6 * depth, depth, depth}, edge);
        ElasticLoad load = pullAtTheEnd(grid, {0, -100, 0});
        load.poisson = 0;
        const std::vector<double> stresses = stressUnder(load, grid);
        const glm::dvec3 centre(grid.lattice().centre({3 * depth, depth - 1, depth / 2}));
        const double arm = 2.4 - static_cast<double>(edge) / 2 - centre.x, inertia = std::pow(0.4, 4) / 12;
        const double expected = 100 * arm * (centre.y - 0.2) / inertia;
        errors.push_back(std::abs(stressAt(stresses, grid, {3 * depth, depth - 1, depth / 2}) / expected - 1));
        EXPECT_LT(stressAt(stresses, grid, {5 * depth, depth - 1, depth / 2}), 0.5 * expected);
    }
    EXPECT_LT(errors[0], 0.2);
    EXPECT_LT(errors[1], 0.4 * errors[0]);
}

TEST(ElasticLoad, IsLinearInTheForceAndFallsWithTheSquareOfTheSize) {
    MemoryLedger ledger;
    const VoxelGrid small = bar(ledger, {8, 3, 3}, 0.1f), large = bar(ledger, {8, 3, 3}, 0.2f);
    const std::vector<double> one = stressUnder(pullAtTheEnd(small, {3, 5, -2}), small);
    const std::vector<double> twice = stressUnder(pullAtTheEnd(small, {6, 10, -4}), small);
    const std::vector<double> wide = stressUnder(pullAtTheEnd(large, {3, 5, -2}), large);
    for (std::size_t e = 0; e < one.size(); ++e) {
        EXPECT_NEAR(twice[e], 2 * one[e], 1e-5 * twice[e]);
        EXPECT_NEAR(wide[e], one[e] / 4, 1e-5 * one[e]);
    }
}

TEST(ElasticLoad, ColoursAVoxelByItsStress) {
    MemoryLedger ledger;
    VoxelGrid grid = bar(ledger, {12, 3, 3}, 0.1f);
    for (Voxel& voxel : grid.voxels()) voxel.colour = voxel.fadingColour = PackedColour({0, 0, 1, 0.5f});
    ElasticLoad load = pullAtTheEnd(grid, {0, -10, 0});
    load.colour = {1, 0, 0};
    const std::vector<double> stresses = stressUnder(load, grid);
    load.fullPascals = static_cast<float>(2 * std::ranges::max(stresses));
    showStress(load, grid);
    for (std::size_t e = 0; e < stresses.size(); ++e) {
        const glm::vec4 colour = grid.voxels()[e].colour.colour();
        EXPECT_NEAR(colour.r, stresses[e] / static_cast<double>(load.fullPascals), 1e-4);
        EXPECT_NEAR(colour.b, 1 - colour.r, 1e-4f);
        EXPECT_NEAR(colour.a, 0.5f, 1e-4f);
    }
}

TEST(ElasticLoad, NamesABoxWithoutVoxelsAndALoadThatNothingHolds) {
    MemoryLedger ledger;
    VoxelGrid grid = bar(ledger, {9, 3, 3}, 0.1f);
    ElasticLoad load = pullAtTheEnd(grid, {1, 0, 0});
    load.held = {glm::vec3(5), glm::vec3(6)};
    EXPECT_THROW((void)stressUnder(load, grid), InputError);
    load = pullAtTheEnd(grid, {1, 0, 0});
    for (const std::uint32_t i : grid.active())  // cut in two
        if (grid.lattice().cell(i).x == 4) grid.voxels()[i].setActive(false);
    grid.listActive();
    try {
        (void)stressUnder(load, grid);
        ADD_FAILURE() << "no equilibrium, no error";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).substr(0, 12), "bar.toml:3: ");
    }
}

TEST(ElasticLoad, IsTheSameAtAnyNumberOfThreads) {
    MemoryLedger ledger;
    const VoxelGrid grid = bar(ledger, {30, 12, 9}, 0.1f);
    const auto at = [&](int threads) {
        std::vector<double> stresses;
        tbb::task_arena(threads).execute([&] { stresses = stressUnder(pullAtTheEnd(grid, {2, 9, 4}), grid); });
        return stresses;
    };
    EXPECT_EQ(at(3), at(1));
}

}  // namespace
}  // namespace dustbench::voxel_shape
