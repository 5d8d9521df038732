#include "bench/measure/rank_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "methods/kit/maths/philox.h"

namespace dustbench::bench {
namespace {

TEST(RankCorrelation, IsOneForWhatRisesAndMinusOneForWhatFalls) {
    EXPECT_EQ(rankCorrelation(std::vector<CostPoint>{{1, 2}, {2, 2.1}, {3, 90}, {4, 91}}), 1);
    EXPECT_EQ(rankCorrelation(std::vector<CostPoint>{{4, 1}, {3, 2}, {1, 7}, {2, 3}}), -1);
}

TEST(RankCorrelation, IsOneLessFourTimesTheShareOfInversions) {
    constexpr std::size_t count = 40;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        std::vector<CostPoint> points;
        std::vector<double> list;
        for (std::size_t i = 0; i < count; ++i) {
            const double cost = maths::unitFloat(maths::randomWords(seed, 0, i)[0]);
            points.push_back({static_cast<double>(i), cost});
            list.push_back(cost);
        }
        // A bubble sort swaps neighbours once for each inversion.
        int inversions = 0;
        for (std::size_t end = count; end > 1; --end)
            for (std::size_t i = 1; i < end; ++i)
                if (list[i] < list[i - 1]) {
                    std::swap(list[i], list[i - 1]);
                    ++inversions;
                }
        EXPECT_NEAR(rankCorrelation(points), 1 - 4.0 * inversions / (count * (count - 1)), 1e-12);
    }
}

TEST(RankCorrelation, CountsTiesForNeitherSide) {
    // Pairs: (1,1)-(1,2) tied in the load, (1,2)-(2,2) tied in the cost, (1,1)-(2,2) concordant: 1/√(2·2).
    EXPECT_DOUBLE_EQ(rankCorrelation(std::vector<CostPoint>{{1, 1}, {1, 2}, {2, 2}}), 0.5);
    EXPECT_EQ(rankCorrelation(std::vector<CostPoint>{{1, 5}, {2, 5}, {3, 5}}), 0);
    EXPECT_TRUE(std::isnan(rankCorrelation(std::vector<CostPoint>{{1, 5}})));
}

}  // namespace
}  // namespace dustbench::bench
