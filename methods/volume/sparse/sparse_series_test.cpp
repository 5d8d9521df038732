// Checks that sparse volumes have the values of dense ones for every type of file, including volumes too large for a
// dense one.
#include "methods/volume/sparse/sparse_series.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/volumes/openvdb/test_grids.h"
#include "methods/kit/volumes/volume_series.h"
#include "methods/volume/sparse/nano_walk.h"
#include "methods/volume/sparse/sparse_storage.h"

namespace dustbench::volume {
namespace {

using testing::HasSubstr;
using FloatGrid = volumes::TestGrid<float>;

std::string writtenVdb(const TestFolder& folder, const std::string& name, const std::vector<FloatGrid>& grids) {
    const std::string path = folder.path() / name;
    volumes::writeVdb(path, {grids.begin(), grids.end()});
    return path;
}

/// Clusters of cells with density, and a larger set with temperature, around `middle`.
std::vector<FloatGrid> clusters(unsigned seed, const glm::ivec3& middle, bool hot, double time) {
    std::mt19937 random(seed);
    FloatGrid density("density"), heat("temperature", /*background=*/300);
    density.setTime(time);
    for (int cluster = 0; cluster < 7; ++cluster) {
        const auto within = [&](int cells) { return static_cast<int>(random() % static_cast<unsigned>(cells)); };
        const glm::ivec3 at = middle + glm::ivec3(within(60) - 30, within(50) - 25, within(80) - 40);
        for (int i = 0; i < 200; ++i) {
            const glm::ivec3 cell = at + glm::ivec3(within(9), within(9), within(9));
            density.set(cell, 0.25f + static_cast<float>(within(1000)) / 500);
            for (int n = 0; n < 3; ++n)
                heat.set(cell + glm::ivec3(within(5) - 2, within(5) - 2, within(5) - 2),
                         400 + static_cast<float>(within(1000)));
        }
    }
    if (hot) return {density, heat};
    return {density};
}

double valueAt(const NanoTree& tree, const glm::ivec3& cell) {
    NanoWalk walk(tree);
    const float* const values = walk.at(cell >> 3).values;
    return values ? static_cast<double>(values[(cell.x & 7) << 6 | (cell.y & 7) << 3 | (cell.z & 7)]) : 0;
}

/// Density in all cells; fire wherever a sample sees both.
void expectSame(const volumes::VolumeGrid& dense, const SparseMoment& sparse, const volumes::VolumeSetup& setup) {
    ASSERT_EQ(sparse.cells, dense.cells);
    EXPECT_EQ(sparse.originMetres, dense.origin);
    EXPECT_EQ(sparse.spacingMetres, dense.spacing);
    const auto densityAt = [&](const glm::ivec3& cell) { return dense.density[dense.indexOf(cell)]; };
    std::size_t burning = 0;
    for (int z = 0; z < dense.cells.z; ++z)
        for (int y = 0; y < dense.cells.y; ++y)
            for (int x = 0; x < dense.cells.x; ++x) {
                const glm::ivec3 cell(x, y, z);
                ASSERT_EQ(valueAt(sparse.density, cell + sparse.firstCell), static_cast<double>(densityAt(cell)))
                    << x << ' ' << y << ' ' << z;
                if (setup.fire.empty()) continue;
                bool isSeen = false;
                for (int n = 0; n < 27; ++n) {
                    const glm::ivec3 there = cell + glm::ivec3(n % 3, n / 3 % 3, n / 9) - 1;
                    isSeen |= glm::clamp(there, glm::ivec3(0), dense.cells - 1) == there && densityAt(there) > 0;
                }
                if (!isSeen) continue;
                const auto cold = static_cast<float>(setup.coldTemperature);
                const float range = static_cast<float>(setup.hotTemperature) - cold;
                const float reaction = std::clamp((dense.temperature[dense.indexOf(cell)] - cold) / range, 0.0f, 1.0f);
                burning += reaction > 0 ? 1 : 0;
                ASSERT_EQ(valueAt(sparse.reaction, cell + sparse.firstCell), static_cast<double>(reaction))
                    << x << ' ' << y << ' ' << z;
            }
    EXPECT_TRUE(setup.fire.empty() || burning > 100);
}

volumes::VolumeSetup setupOf(const std::filesystem::path& files, bool hot, double cold = 350) {
    volumes::VolumeSetup setup;
    setup.files = files;
    if (!hot) return setup;
    setup.fire = "flame.toml";
    setup.coldTemperature = cold;
    setup.hotTemperature = 1200;
    setup.fields.wantsTemperature = true;
    return setup;
}

TEST(SparseSeries, HasEveryValueOfTheDenseOne) {
    const TestFolder folder;
    for (const bool hot : {false, true})
        for (const bool zUp : {false, true}) {
            volumes::VolumeSetup setup =
                setupOf(writtenVdb(folder, "a.vdb", clusters(5, {-1234, 77, -3}, hot, 0)), hot);
            setup.zUp = zUp;
            setup.metresPerUnit = 0.125;
            setup.position = {3, 4, 5};
            MemoryLedger ledger;
            SparseSeries sparse(setup, ledger);
            EXPECT_TRUE(sparse.isStill());
            volumes::VolumeGrid between;
            expectSame(volumes::VolumeSeries::read(setup).at(0, false, between), sparse.at(0), setup);
        }
}

TEST(SparseSeries, ChangesEvenlyBetweenItsMomentsWhereverTheyLie) {
    const TestFolder folder;
    // Moments that overlap partly, and not at all.
    for (const int apart : {0, 13, 150})
        for (const bool hot : {false, true}) {
            for (int i = 0; i < 3; ++i)
                (void)writtenVdb(folder, fmt::format("s{}.vdb", i),
                                 clusters(7 + static_cast<unsigned>(i), {-20 - i * apart, i * apart, 11}, hot, i));
            const volumes::VolumeSetup setup = setupOf(folder.path() / "s*.vdb", hot, /*cold=*/-100);
            MemoryLedger ledger;
            SparseSeries sparse(setup, ledger);
            const auto dense = volumes::VolumeSeries::read(setup);
            EXPECT_EQ(sparse.seconds(), 2);
            volumes::VolumeGrid between;
            std::int64_t shows = 0;
            for (const double seconds : {-1.0, 0.25, 0.75, 1.0, 1.5, 9.0, 0.25}) {
                expectSame(dense.at(seconds, false, between), sparse.at(seconds), setup);
                EXPECT_NE(sparse.shows(), shows);
                shows = sparse.shows();
                (void)sparse.at(seconds);
                EXPECT_EQ(sparse.shows(), shows);
            }
        }
}

/// Two balls of fog so far from each other that the box around them has 300 million cells.
std::string farApart(const TestFolder& folder, double& sum) {
    FloatGrid grid("density");
    sum = 0;
    for (const glm::ivec3& middle : {glm::ivec3(-5, 3, -40), glm::ivec3(475, 483, 1260)})
        for (int i = 0; i < 17 * 17 * 17; ++i) {
            const glm::ivec3 from(i % 17 - 8, i / 17 % 17 - 8, i / 289 - 8);
            const auto density =
                static_cast<float>(8 - std::sqrt(static_cast<double>(glm::dot(glm::dvec3(from), glm::dvec3(from)))));
            if (!(density > 0)) continue;
            grid.set(middle + from, density);
            sum += static_cast<double>(density);
        }
    return writtenVdb(folder, "far.vdb", {grid});
}

TEST(SparseSeries, HoldsWhatADenseOneCannot) {
    const TestFolder folder;
    double sum = 0;
    const volumes::VolumeSetup setup = setupOf(farApart(folder, sum), false);
    EXPECT_THAT(inputError([&] { (void)volumes::VolumeSeries::read(setup); }),
                HasSubstr("the box of its density has more than 256 million cells"));
    MemoryLedger ledger;
    SparseSeries sparse(setup, ledger);
    const SparseMoment& moment = sparse.at(0);
    EXPECT_GT(moment.place().cellCount(), 256'000'000u);
    EXPECT_DOUBLE_EQ(moment.density.sum(), sum);
    // A box of floats would take 1.2 GB.
    EXPECT_LT(ledger.totalBytes(), 3'000'000u);
}

struct Nobody final : VolumeVisitor {
    void puffs(const Puffs&) override {}
    void octree(const OctreeVolume&) override {}
    void grid(const GridVolume&) override {}
};

TEST(SparseStorage, ShowsWhatADenseOneCannotHoldButDoesNotHandOverItsBox) {
    const TestFolder folder;
    double sum = 0;
    VolumeSettings settings;
    settings.setup = setupOf(farApart(folder, sum), false);
    settings.picture.extinctionPerMetre = 0.5;
    for (const raycast::Backend backend : {raycast::Backend::cpu, raycast::Backend::gl}) {
        settings.picture.backend = backend;
        // Through both balls, and 1,200 empty cells between them.
        draw::TestCanvas canvas(32, 24, {-20, -12, -80}, {480, 480, 1300});
        canvas.view.camera.verticalFieldOfView = 0.5;
        SparseStorage storage(settings, {}, draw::TestCanvas::device());
        storage.show(0, StageClock());
        const pictures::Image image = canvas.picture([&](gpu::Layer& layer) { storage.draw(canvas.view, layer); });
        float most = 0;
        for (const glm::vec4& pixel : image.pixels) most = std::max(most, pixel.a);
        EXPECT_GT(most, 0.9f);
        EXPECT_NEAR(storage.massSquareMetres(), 0.5 * sum, 1e-9 * sum);
        Nobody nobody;
        EXPECT_THAT(
            inputError([&] { storage.handOver(0, nobody); }),
            HasSubstr("the whole box of the volume has 3.222e+08 cells, allowed for a dense copy: 2.56e+08 (limit of "
                      "volumes)"));
    }
}

TEST(SparseSeries, RefusesWhatADenseOneRefuses) {
    const TestFolder folder;
    const auto refusal = [&](const std::vector<FloatGrid>& grids, bool hot = false) {
        const volumes::VolumeSetup setup = setupOf(writtenVdb(folder, "a.vdb", grids), hot);
        MemoryLedger ledger;
        const std::string sparse = inputError([&] { SparseSeries(setup, ledger); });
        EXPECT_EQ(sparse, inputError([&] { (void)volumes::VolumeSeries::read(setup); }));
        return sparse;
    };
    const auto grids = clusters(3, {0, 0, 0}, true, 0);
    const FloatGrid &density = grids[0], &heat = grids[1];
    const auto with = [&](const FloatGrid& grid, float value, bool hot = false) {
        FloatGrid copy = grid.deepCopy();
        copy.set(grid.firstCell() + 5, value);
        return refusal(&grid == &density ? std::vector{copy, heat} : std::vector{density, copy}, hot);
    };
    EXPECT_THAT(with(density, -0.5f), HasSubstr("it has a density of -0.5, allowed: 0 or more"));
    EXPECT_THAT(with(density, NAN), HasSubstr("it has a density that is not a number"));
    EXPECT_THAT(refusal({density}, true), HasSubstr("it has no field of numbers 'temperature'"));
    MemoryLedger ledger;
    EXPECT_EQ(inputError([&] { SparseSeries(setupOf(folder.write("a.raw", "1"), false), ledger); }),
              (folder.path() / "a.raw").string() + ": expected a file that ends in .vdb, .nvdb or .vti");
    // Overshoot counts as zero.
    FloatGrid overshoot = density.deepCopy();
    overshoot.set({0, 0, 0}, -0.0005f);
    const volumes::VolumeSetup setup = setupOf(writtenVdb(folder, "b.vdb", {overshoot}), false);
    SparseSeries sparse(setup, ledger);
    volumes::VolumeGrid between;
    expectSame(volumes::VolumeSeries::read(setup).at(0, false, between), sparse.at(0), setup);
}

TEST(SparseSeries, RefusesBoxesBeyondItsOwnLimits) {
    const TestFolder folder;
    FloatGrid grid("density");
    grid.set({0, 0, 0}, 1);
    const auto refusal = [&](const glm::ivec3& other) {
        auto both = grid.deepCopy();
        both.set(other, 1);
        const volumes::VolumeSetup setup = setupOf(writtenVdb(folder, "a.vdb", {both}), false);
        MemoryLedger ledger;
        return inputError([&] { SparseSeries(setup, ledger); });
    };
    EXPECT_THAT(refusal({1300, 1300, 1300}), HasSubstr("more than 2 billion cells (limit of sparse volumes)"));
    EXPECT_THAT(refusal({1, 1, 65'536}),
                HasSubstr("it has 65537 cells along an axis, allowed: 65536 (limit of sparse volumes)"));
    // Moments on different lattices, or too far apart for one.
    (void)writtenVdb(folder, "s0.vdb", {grid});
    const auto moment = [&](const glm::dvec3& at) {
        auto moved = grid.deepCopy();
        moved.translate(at);
        (void)writtenVdb(folder, "s1.vdb", {moved});
        volumes::VolumeSetup setup = setupOf(folder.path() / "s*.vdb", false);
        setup.secondsPerFile = 1;
        MemoryLedger ledger;
        return inputError([&] { SparseSeries(setup, ledger); });
    };
    EXPECT_THAT(moment({0.4, 0, 0}), HasSubstr("s1.vdb: is on a different grid from s0.vdb"));
    EXPECT_THAT(moment({9e6, 0, 0}), HasSubstr("s1.vdb: it is 9e+06 cells away from the first of its series"));
    EXPECT_THAT(moment({2000, 2000, 2000}), HasSubstr("it has more than 2000000000 cells (limit of volumes)"));
}

}  // namespace
}  // namespace dustbench::volume
