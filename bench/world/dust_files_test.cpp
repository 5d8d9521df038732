#include "bench/world/dust_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "bench/world/dust_series.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::world {
namespace {

using testing::HasSubstr;
using volumes::VolumeGrid;
using volumes::VolumeSeries;
using volumes::VolumeSetup;

/// A puff in the world.
struct Gaussian {
    glm::dvec3 centre{0.11, 0.23, -0.17};
    double opacity = 0.7, radius = 1;
};

double share(double centre, double s, double low, double edge) {
    const double scale = 1 / (std::numbers::sqrt2 * s);
    return 0.5 * (std::erf((low + edge - centre) * scale) - std::erf((low - centre) * scale));
}

/// Extinction of the puff averaged over cells with this edge, in a box of ±3 m, which contains all but 1e-8 of it.
VolumeGrid gridOf(const Gaussian& puff, double edge, double time = 0) {
    VolumeGrid grid;
    grid.cells = glm::ivec3(static_cast<int>(std::lround(6 / edge)));
    grid.origin = glm::dvec3(-3);
    grid.spacing = edge;
    grid.timeSeconds = time;
    const double s = maths::puffDeviationMetres(puff.radius);
    const double mass = maths::puffMassSquareMetres(puff.opacity, puff.radius);
    std::vector<double> along[3];
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < grid.cells[axis]; ++i)
            along[axis].push_back(share(puff.centre[axis], s, -3 + i * edge, edge));
    for (const double z : along[2])
        for (const double y : along[1])
            for (const double x : along[0])
                grid.density.push_back(static_cast<float>(mass * x * y * z / (edge * edge * edge)));
    return grid;
}

double massOf(const VolumeGrid& grid) {
    return std::accumulate(grid.density.begin(), grid.density.end(), 0.0) * std::pow(grid.spacing, 3);
}

double massOf(const Puffs& dust) {
    double sum = 0;
    for (std::size_t i = 0; i < dust.size(); ++i)
        sum += maths::puffMassSquareMetres(static_cast<double>(dust.opacity[i]), static_cast<double>(dust.radius[i]));
    return sum;
}

class VolumeDust : public testing::Test {
 protected:
    [[nodiscard]] Puffs shown(std::vector<VolumeGrid> grids, double seconds = 0, const VolumeSetup& setup = {}) {
        const VolumeSeries series(std::move(grids), {"a.vdb", "b.vdb", "c.vdb"});
        DustSeries(dustOfVolume(series, setup)).show(seconds, store_);
        return store_;
    }

    MemoryLedger ledger_;
    particles::ParticleStore store_{ledger_};
};

TEST_F(VolumeDust, HasAllOfTheVolumesMassAtAnyBlocksAndExtinction) {
    const VolumeGrid grid = gridOf({}, 0.25);
    VolumeSetup setup;
    const double mass = massOf(grid);
    for (const int block : {1, 2, 5})
        for (const double extinction : {1.0, 2.5}) {
            setup.blockCells = block;
            setup.extinctionPerMetre = extinction;
            EXPECT_NEAR(massOf(shown({grid}, 0, setup)), extinction * mass, 2e-7 * mass)
                << block << " cells, " << extinction << " per metre";
        }
}

TEST_F(VolumeDust, ItsDepthsAreThoseOfTheVolumeByTheSquareOfTheCellsEdge) {
    const Gaussian puff;
    const auto worst = [&](double edge) {
        const Puffs dust = shown({gridOf(puff, edge)});
        double maximum = 0;
        for (int ray = 0; ray < 20; ++ray) {
            const glm::dvec3 eye(7 * std::cos(0.3 * ray), 1.5, 7 * std::sin(0.3 * ray));
            const glm::dvec3 target(0.07 * ray, 0.03 * ray - 0.4, 0.2 - 0.05 * ray);
            const glm::dvec3 along = glm::normalize(target - eye);
            const auto depth = [&](const glm::dvec3& centre, double opacity, double radius) {
                const double foot = glm::dot(centre - eye, along);
                return maths::rayOpticalDepth(opacity, radius, glm::length(centre - eye - foot * along), foot, 0, 1e3);
            };
            double sum = 0;
            for (std::size_t i = 0; i < dust.size(); ++i)
                sum +=
                    depth(dust.position(i), static_cast<double>(dust.opacity[i]), static_cast<double>(dust.radius[i]));
            maximum = std::max(maximum, std::abs(sum - depth(puff.centre, puff.opacity, puff.radius)));
        }
        return maximum;
    };
    const double coarse = worst(0.25), fine = worst(0.125);
    EXPECT_LT(coarse, 0.18);
    EXPECT_LT(fine, 0.05);
    EXPECT_GT(coarse / fine, 3.2);
    EXPECT_LT(coarse / fine, 4.8);
}

TEST_F(VolumeDust, BetweenMomentsItChangesAsTheVolumeDoes) {
    Gaussian there;
    there.centre = {0.8, 0, 0};
    there.opacity = 0.4;
    const VolumeGrid from = gridOf({}, 0.25, 2), to = gridOf(there, 0.25, 4);
    const double expected = 0.75 * massOf(from) + 0.25 * massOf(to);
    EXPECT_NEAR(massOf(shown({from, to}, 0.5)), expected, 2e-7 * expected);
    EXPECT_NEAR(massOf(shown({from, to}, 2)), massOf(to), 2e-7 * massOf(to));
    // Cells that appear or disappear between two moments exist during the whole interval.
    VolumeGrid left = gridOf({}, 0.5, 0), right = left;
    std::ranges::fill(left.density, 0.0f);
    std::ranges::fill(right.density, 0.0f);
    right.timeSeconds = 1;
    left.density[0] = right.density[7] = 0.1f;
    const Puffs dust = shown({left, right}, 0.5);
    ASSERT_EQ(dust.size(), 2u);
    EXPECT_FLOAT_EQ(dust.opacity[0], dust.opacity[1]);
    EXPECT_NEAR(massOf(dust), massOf(left), 1e-6 * massOf(left));
}

TEST_F(VolumeDust, TakesTheMeanVelocityOfItsBlockByMass) {
    VolumeGrid grid;
    grid.cells = {2, 1, 1};
    grid.spacing = 1;
    grid.density = {0.3f, 0.1f};
    grid.velocity = {{1, 0, 0}, {5, 4, 0}};
    VolumeSetup setup;
    setup.blockCells = 2;
    const Puffs dust = shown({grid}, 0, setup);
    ASSERT_EQ(dust.size(), 1u);
    EXPECT_EQ(dust.position(0), glm::vec3(1));
    EXPECT_FLOAT_EQ(dust.velocityX[0], 2);
    EXPECT_FLOAT_EQ(dust.velocityY[0], 1);
}

TEST_F(VolumeDust, CellsDenserThanAPuffCanBeAreRefused) {
    VolumeGrid grid = gridOf({}, 0.5);
    grid.density[3] = 50;
    EXPECT_THAT(inputError([&] { (void)shown({grid}); }),
                HasSubstr("a.vdb: a cell has an optical depth of 25 along its edge, allowed for particles: 21.3"));
}

TEST(VolumeDustFile, AVolumeIsDustAndItsSetupToo) {
    const TestFolder folder;
    const std::string vti =
        "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\"><ImageData WholeExtent=\"0 2 0 1 0 "
        "1\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 2 0 1 0 1\"><CellData><DataArray type=\"Float32\" "
        "Name=\"smoke\" format=\"ascii\">0.25 0</DataArray></CellData></Piece></ImageData></VTKFile>";
    const auto file = folder.write("a.vti", vti);
    const auto setup = folder.write("a.toml", "files = \"a.vti\"\nup = \"z\"\nposition = [0, 0, 9]\n");
    MemoryLedger ledger;
    particles::ParticleStore store(ledger);
    const DustSeries of = DustSeries::read(file, "");
    of.show(0, store);
    ASSERT_EQ(store.size(), 1u);
    EXPECT_EQ(Puffs(store).position(0), glm::vec3(0.5f));
    const DustSeries turned = DustSeries::read(setup, "");
    turned.show(0, store);
    EXPECT_EQ(Puffs(store).position(0), glm::vec3(0.5f, 0.5f, 8.5f));
    EXPECT_THAT(turned.files(), testing::UnorderedElementsAre(setup, file));
    EXPECT_THAT(inputError([&] { (void)DustSeries::read(file, "radius=1"); }),
                HasSubstr("--dust-columns: not allowed with the volume"));
}

}  // namespace
}  // namespace dustbench::world
