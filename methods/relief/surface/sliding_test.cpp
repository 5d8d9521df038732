#include "methods/relief/surface/sliding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {
namespace {

scene::Relief reliefOf(int columns, int rows, float depth, unsigned seed = 0) {
    scene::Relief relief{columns, rows, std::vector<float>(static_cast<std::size_t>(columns * rows), depth), {}};
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> any(0.3f, 1);
    if (seed > 0)
        for (float& each : relief.depth) each = any(random);
    return relief;
}

void lay(WornSurface& surface, float u, float v, float radius, std::uint32_t depth, const Repose& repose) {
    surface.scatter(std::vector<Impact>{{u, v, radius, depth}});
    surface.layOn(repose);
}

/// The steepest slope of texels with a deposit.
double steepest(const WornSurface& surface, const Repose& repose) {
    double most = 0;
    for (int row = 0; row < surface.depths().rows(); ++row)
        for (int column = 0; column < surface.depths().columns(); ++column)
            if (surface.laid()[surface.depths().texel(column, row)] > 0)
                most = std::max(most, glm::length(slopeDown(surface.depths(), column, row, repose)));
    return most;
}

std::uint64_t laidNow(const WornSurface& surface) {
    std::uint64_t volume = 0;
    for (const std::uint32_t laid : surface.laid()) volume += laid;
    return volume;
}

TEST(Sliding, NothingLiesSteeperThanItsAngleAndNothingIsLost) {
    for (const unsigned seed : {1u, 2u, 3u})
        for (const double tangent : {0.2, 0.7, 2.0}) {
            MemoryLedger ledger;
            WornSurface surface(reliefOf(61, 47, 0, seed), ledger);
            const Repose repose{tangent, {0.02, 0.03}, 0.1};
            std::mt19937 random(seed);
            std::uniform_real_distribution<float> share(0, 1);
            for (int hit = 0; hit < 200; ++hit) {
                lay(surface, 61 * share(random), 47 * share(random), 1 + 3 * share(random),
                    static_cast<std::uint32_t>(share(random) * DepthMap::bottom / 10), repose);
                ASSERT_EQ(surface.presentVolume(), surface.initialVolume() + surface.laidOnVolume());
            }
            EXPECT_LE(steepest(surface, repose), tangent * (1 + 1e-12));
            EXPECT_EQ(laidNow(surface), surface.laidOnVolume());
            EXPECT_GT(surface.laidOnVolume(), 0u);
        }
}

TEST(Sliding, TenThousandHitsKeepTheVolumeToTheLastBit) {
    MemoryLedger ledger;
    WornSurface surface(reliefOf(128, 96, 0, 5), ledger);
    const Repose repose{0.6, {0.01, 0.01}, 0.05};
    std::mt19937 random(8);
    std::uniform_real_distribution<float> share(0, 1);
    for (int round = 0; round < 100; ++round) {
        std::vector<Impact> impacts(100);
        for (Impact& impact : impacts)
            impact = {128 * share(random), 96 * share(random), 1.5f,
                      static_cast<std::uint32_t>(share(random) * DepthMap::bottom / 100)};
        surface.scatter(impacts);
        round % 4 == 3 ? surface.takeOff() : surface.layOn(repose);
        ASSERT_EQ(surface.presentVolume(), surface.initialVolume() - surface.takenOffVolume() + surface.laidOnVolume());
    }
}

// A heap on a plane is the cone of its volume: V = ⅓·π·h³/tan²φ, with a radius of h/tan φ.
TEST(Sliding, AHeapOnAPlaneIsTheConeOfItsVolume) {
    constexpr int side = 101;
    for (const double tangent : {0.5, 0.75}) {
        MemoryLedger ledger;
        WornSurface surface(reliefOf(side, side, 1), ledger);
        const Repose repose{tangent, {0.01, 0.01}, 0.5};
        for (int n = 0; n < 60; ++n) lay(surface, 50, 50, 4, DepthMap::bottom / 20, repose);
        const double cell = 0.01 * 0.01 * 0.5 / DepthMap::bottom;
        const double volume = cell * static_cast<double>(surface.laidOnVolume());
        const double height = std::cbrt(3 * volume * tangent * tangent / std::numbers::pi);
        const double radius = height / tangent;
        ASSERT_GT(radius, 0.15);
        // The upwind gradient sees an apex between texels: a texel of height, and as much of radius.
        EXPECT_NEAR(0.5 * (1 - surface.depths().at(50, 50)), height, 1.5 * 0.01 * tangent) << tangent;
        double difference = 0;
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const double away = 0.01 * std::hypot(column - 50, row - 50);
                const double cone = std::max(0.0, height - tangent * away);
                difference += std::abs(0.5 * (1 - surface.depths().at(column, row)) - cone) * 0.01 * 0.01;
            }
        EXPECT_LT(difference / volume, 0.08) << tangent;
    }
}

TEST(Sliding, TheSurfaceItselfStays) {
    MemoryLedger ledger;
    const scene::Relief relief = reliefOf(30, 30, 0, 4);
    WornSurface surface(relief, ledger);
    const Repose repose{0.01, {0.01, 0.01}, 0.5};  // all slopes are steeper
    for (int n = 0; n < 20; ++n) lay(surface, 15, 15, 3, DepthMap::bottom / 50, repose);
    const DepthMap fresh(relief, ledger);
    for (std::size_t i = 0; i < fresh.size(); ++i)
        ASSERT_EQ(surface.depths().depths()[i] + surface.laid()[i], fresh.depths()[i]);
}

TEST(Sliding, SaysWhichTexelsChanged) {
    MemoryLedger ledger;
    WornSurface surface(reliefOf(80, 60, 1), ledger);
    const std::vector<std::uint32_t> before(surface.depths().depths().begin(), surface.depths().depths().end());
    static_cast<void>(surface.takeChanged());
    lay(surface, 30, 20, 2, DepthMap::bottom / 2, {0.3, {0.01, 0.01}, 0.2});
    const TexelRectangle changed = surface.takeChanged();
    int within = 0;
    for (int row = 0; row < 60; ++row)
        for (int column = 0; column < 80; ++column) {
            const std::size_t i = surface.depths().texel(column, row);
            const bool inside = column >= changed.firstColumn && column < changed.endColumn &&
                                row >= changed.firstRow && row < changed.endRow;
            if (inside)
                ++within;
            else
                ASSERT_EQ(surface.depths().depths()[i], before[i]);
        }
    EXPECT_GT(within, 25);
    EXPECT_LT(within, 80 * 60);
}

}  // namespace
}  // namespace dustbench::relief
