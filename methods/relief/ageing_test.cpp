#include "methods/relief/ageing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "methods/relief/ageing_experiment.h"
#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {
namespace {

scene::Panel flatPanel(int side, double edgeMetres, double depthMetres) {
    auto relief = std::make_shared<scene::Relief>();
    relief->columns = relief->rows = side;
    relief->depth.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.2f);
    scene::Panel panel;
    panel.sizeMetres = glm::dvec2(edgeMetres);
    panel.depthMetres = depthMetres;
    panel.relief = relief;
    return panel;
}

SurfaceHit hitWith(const glm::vec3& velocity) {
    return {{63.3f, 64.8f, 0.2f}, velocity, {0, 0, 1}, {}, 1};
}

double volumeTaken(const WornSurface& surface, const scene::Panel& panel, const TexelFrame& texels) {
    return static_cast<double>(surface.takenOffVolume()) / DepthMap::bottom * panel.depthMetres *
           texels.texelAreaSquareMetres();
}

// From pits of many texels to pits far smaller than one: the volume always follows the law.
TEST(Ageing, ACraterHasTheVolumeOfItsLawAtAnySize) {
    const scene::Panel panel = flatPanel(128, 1, 1);
    const TexelFrame texels(panel);
    for (const double hardness : {1e3, 1e4, 1e5, 1e6, 1e7}) {
        MemoryLedger ledger;
        WornSurface surface(*panel.relief, ledger);
        const AgeingSettings settings{.hardnessJoulesPerCubicMetre = hardness};
        const SurfaceHit hit = hitWith({0.5f, 0, -3});
        const double expected = 0.5 * settings.massKilograms * 9 / hardness;
        EXPECT_NEAR(volumeCubicMetres(hit, settings), expected, 1e-12 * expected);
        surface.scatter(std::vector<Impact>{impactOf(hit, settings, texels, panel.depthMetres)});
        surface.takeOff();
        // A paraboloid of 1.5 texels sampled at the texels is off by up to a tenth, depending on its position.
        EXPECT_NEAR(volumeTaken(surface, panel, texels) / expected, 1, 0.12) << hardness;
    }
}

TEST(Ageing, AveragedOverPlacesASmallPitHasItsVolume) {
    const scene::Panel panel = flatPanel(128, 1, 1);
    const TexelFrame texels(panel);
    const AgeingSettings settings{.hardnessJoulesPerCubicMetre = 1e7};
    double sum = 0;
    constexpr int places = 40;
    for (int i = 0; i < places; ++i)
        for (int j = 0; j < places; ++j) {
            MemoryLedger ledger;
            WornSurface surface(*panel.relief, ledger);
            SurfaceHit hit = hitWith({0, 0, -3});
            hit.texels = {60 + (i + 0.5f) / places, 60 + (j + 0.5f) / places, 0.2f};
            surface.scatter(std::vector<Impact>{impactOf(hit, settings, texels, panel.depthMetres)});
            surface.takeOff();
            sum += volumeTaken(surface, panel, texels);
        }
    EXPECT_NEAR(sum / (places * places) / volumeCubicMetres(hitWith({0, 0, -3}), settings), 1, 2e-3);
}

TEST(Ageing, EnergyAndAngleCountByTheVelocityAgainstTheSurface) {
    const AgeingSettings settings;
    const double straight = volumeCubicMetres(hitWith({0, 0, -2}), settings);
    EXPECT_NEAR(volumeCubicMetres(hitWith({0, 0, -4}), settings) / straight, 4, 1e-6);
    EXPECT_NEAR(volumeCubicMetres(hitWith({7, -3, -2}), settings) / straight, 1, 1e-6);
    const float slanting = static_cast<float>(2 * std::sin(std::numbers::pi / 6));
    EXPECT_NEAR(volumeCubicMetres(hitWith({1, 0, -slanting}), settings) / straight, 0.25, 1e-6);
    EXPECT_EQ(volumeCubicMetres(hitWith({5, 0, 0.1f}), settings), 0);  // along the surface or away from it
}

TEST(Ageing, ThePapersHitSinksOneTexelToTheBottom) {
    const scene::Panel panel = flatPanel(128, 1, 0.1);
    const Impact impact = impactOf(hitWith({0, 0, -1}), {.model = AgeingModel::paper}, TexelFrame(panel), 0.1);
    MemoryLedger ledger;
    WornSurface surface(*panel.relief, ledger);
    surface.scatter(std::vector<Impact>{impact});
    surface.takeOff();
    for (std::size_t i = 0; i < surface.depths().size(); ++i)
        ASSERT_EQ(surface.depths().depths()[i] == DepthMap::bottom, i == surface.depths().texel(63, 65));
}

TEST(Ageing, ADepositHasTheVolumeOfItsMass) {
    const scene::Panel panel = flatPanel(128, 1, 1);
    const TexelFrame texels(panel);
    const AgeingSettings settings{.model = AgeingModel::deposit, .massKilograms = 0.5};
    MemoryLedger ledger;
    WornSurface surface(*panel.relief, ledger);
    surface.scatter(std::vector<Impact>{impactOf(hitWith({0, 0, -1}), settings, texels, panel.depthMetres)});
    surface.layOn();
    const double laid = static_cast<double>(surface.laidOnVolume()) / DepthMap::bottom * texels.texelAreaSquareMetres();
    EXPECT_NEAR(laid / (0.5 / 1500), 1, 0.05);
}

// Cells of a power law, one of them skipped.
TEST(AgeingCost, FindsTheExponentsOfAPowerLaw) {
    std::vector<ageing::CostCell> cells;
    for (const int side : {4, 16, 64})
        for (const int hits : {10, 100, 1000}) {
            ageing::CostCell& cell = cells.emplace_back(ageing::CostCell{side, hits, {}});
            if (side < 64 || hits < 1000) cell.seconds = {3 * std::pow(hits, 0.8) * std::pow(cell.texels(), 1.3)};
        }
    const ageing::Exponents found = ageing::exponentsOf(cells, 0);
    EXPECT_NEAR(found.overHits, 0.8, 1e-12);
    EXPECT_NEAR(found.overTexels, 1.3, 1e-12);
}

// One falls with the texels and the other grows: they meet at 100 texels.
TEST(AgeingCost, FindsWhereTwoCurvesCross) {
    std::vector<ageing::CostCell> rising, falling;
    for (const int side : {2, 8, 32}) {
        rising.push_back({side, 1, {static_cast<double>(side) * side}});
        falling.push_back({side, 1, {1e4 / (static_cast<double>(side) * side)}});
    }
    EXPECT_NEAR(ageing::crossoverTexels(rising, falling, 0), 100, 1e-9);
    EXPECT_TRUE(std::isnan(ageing::crossoverTexels(rising, rising, 0)));
}

TEST(AgeingCost, SkipsWhatTakesTooManyTests) {
    const auto gather = ageing::measureCost({.sides = {16, 1024}, .hits = {3, 100'000}, .rounds = 2});
    ASSERT_EQ(gather.size(), 4u);
    for (const std::size_t i : {0u, 1u, 2u}) EXPECT_EQ(gather[i].seconds.size(), 2u) << i;
    EXPECT_TRUE(gather[3].seconds.empty());
    EXPECT_GT(gather[3].tests(), ageing::maximumTests);
    const auto scatter =
        ageing::measureCost({.search = Search::scatter, .sides = {1024}, .hits = {100'000}, .rounds = 1});
    EXPECT_EQ(scatter.at(0).seconds.size(), 1u);  // which makes no tests
}

}  // namespace
}  // namespace dustbench::relief
