#include "methods/relief/surface/surface_hit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dustbench::relief {
namespace {

scene::Relief randomGreyRelief(int columns, int rows, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> depth(0, 1);
    scene::Relief relief{columns, rows, {}, {}};
    for (int i = 0; i < columns * rows; ++i) relief.depth.push_back(depth(random));
    relief.colour.assign(relief.depth.size(), glm::vec3(0.5f));
    return relief;
}

class SurfaceHitTest : public testing::Test {
 protected:
    MemoryLedger ledger_;
};

/// Returns the first of `steps` equal pieces of the segment whose end is below the surface.
std::optional<double> marched(const DepthMap& map, const glm::dvec3& from, const glm::dvec3& to, int steps) {
    for (int k = 0; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        const glm::dvec3 place = glm::mix(from, to, t);
        if (place.z >= map.depthAt(place.x, place.y)) return t;
    }
    return std::nullopt;
}

// The march may step over a sliver of the surface and then hit later or not at all; it never hits earlier.
TEST_F(SurfaceHitTest, AMillionRandomSegmentsMeetTheSurfaceWhereAMarchDoesOrBefore) {
    const DepthMap map(randomGreyRelief(23, 17, 5), ledger_);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-4, 27), v(-4, 21), d(-0.2, 1.05), length(0, 1);
    constexpr int steps = 64;
    int hits = 0, earlier = 0;
    for (int n = 0; n < 1'000'000; ++n) {
        const glm::dvec3 from(u(random), v(random), d(random));
        const glm::dvec3 to = glm::mix(from, glm::dvec3(u(random), v(random), d(random)), std::pow(length(random), 3));
        const auto exact = firstHit(map, from, to);
        const auto coarse = marched(map, from, to, steps);
        if (coarse) {
            ASSERT_TRUE(exact) << "segment " << n << " tunnels";
            ASSERT_LE(*exact, *coarse + 1e-12) << "segment " << n;
        }
        if (!exact) continue;
        ++hits;
        const glm::dvec3 place = glm::mix(from, to, *exact);
        ASSERT_GE(place.z, map.depthAt(place.x, place.y) - 1e-9) << "segment " << n;
        if (*exact > 0) {
            ASSERT_NEAR(place.z, map.depthAt(place.x, place.y), 1e-9) << "segment " << n;
            // There is no earlier hit: a finer march along the path before it finds none.
            if (n % 50 == 0) {
                const auto before = marched(map, from, glm::mix(from, to, *exact * (1 - 1e-9)), 2000);
                ASSERT_FALSE(before && *before < 1) << "segment " << n;
            }
        }
        earlier += coarse && *exact < *coarse - 1.0 / steps ? 1 : 0;
    }
    EXPECT_GT(hits, 500'000);
    EXPECT_GT(earlier, 100);  // slivers that a march misses are hit
}

TEST_F(SurfaceHitTest, AFlatReliefIsAPlane) {
    scene::Relief flat{4, 4, std::vector<float>(16, 0.25f), {}};
    const DepthMap map(flat, ledger_);
    EXPECT_NEAR(*firstHit(map, {1.2, 0.7, 0}, {2.9, 3.1, 1}), 0.25, 1e-12);
    EXPECT_NEAR(*firstHit(map, {1.2, 0.7, 0}, {1e6, -1e6, 0.5}), 0.5, 1e-12);  // a million texels per step
    EXPECT_FALSE(firstHit(map, {1, 1, 0}, {2, 2, 0.2}));
    EXPECT_EQ(firstHit(map, {1, 1, 0.3}, {2, 2, 0}), 0.0);
    EXPECT_EQ(firstHit(map, {1, 1, 0.2}, {1, 1, 0.2}), std::nullopt);
}

}  // namespace
}  // namespace dustbench::relief
