#include "methods/kit/draw/depth_sort.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace dustbench::draw {
namespace {

using Order = std::vector<std::uint32_t>;

Order sorted(SortKind kind, const std::vector<float>& depths) {
    MemoryLedger ledger;
    DepthSort sort(ledger);
    const auto order = sort.farToNear(kind, depths);
    return {order.begin(), order.end()};
}

/// The same order, computed independently.
Order stableSorted(const std::vector<float>& depths) {
    Order order(depths.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return depths[a] > depths[b]; });
    return order;
}

std::vector<float> randomDepths(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-50, 200);
    std::vector<float> depths(count);
    for (float& depth : depths) depth = uniform(random);
    return depths;
}

class DepthSortOf : public testing::TestWithParam<SortKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, DepthSortOf, testing::Values(SortKind::quicksort, SortKind::radix));

TEST_P(DepthSortOf, EqualsTheStandardStableSortAtAnySize) {
    for (const std::size_t count : {0u, 1u, 2u, 3u, 23u, 24u, 25u, 100u, 2047u, 2049u, 65'537u, 300'001u})
        EXPECT_EQ(sorted(GetParam(), randomDepths(count, 7)), stableSorted(randomDepths(count, 7))) << count;
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        const auto depths = randomDepths(seed * 37 % 997, seed);
        EXPECT_EQ(sorted(GetParam(), depths), stableSorted(depths)) << seed;
    }
}

TEST_P(DepthSortOf, KeepsTheOrderOfEquals) {
    std::vector<float> depths = randomDepths(200'000, 3);
    for (float& depth : depths) depth = std::round(depth);
    EXPECT_EQ(sorted(GetParam(), depths), stableSorted(depths));

    const Order same = sorted(GetParam(), std::vector<float>(130'000, 2.5f));
    EXPECT_TRUE(std::is_sorted(same.begin(), same.end()));
}

TEST_P(DepthSortOf, TakesEveryFiniteFloat) {
    using Limits = std::numeric_limits<float>;
    const std::vector<float> depths{0.0f,
                                    -0.0f,
                                    1.0f,
                                    -1.0f,
                                    Limits::max(),
                                    Limits::lowest(),
                                    Limits::denorm_min(),
                                    -Limits::denorm_min(),
                                    Limits::min(),
                                    -0.0f,
                                    0.0f,
                                    1e-20f,
                                    1e20f};
    EXPECT_EQ(sorted(GetParam(), depths), stableSorted(depths));
    std::mt19937 random(5);
    std::vector<float> any;
    while (any.size() < 250'000)
        if (const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random())); std::isfinite(value))
            any.push_back(value);
    EXPECT_EQ(sorted(GetParam(), any), stableSorted(any));
}

TEST_P(DepthSortOf, TakesInputsThatDefeatSimplePivots) {
    const std::size_t count = 100'000;
    std::vector<float> rising(count), falling(count), organPipe(count), sawtooth(count);
    for (std::size_t i = 0; i < count; ++i) {
        rising[i] = static_cast<float>(i);
        falling[i] = static_cast<float>(count - i);
        organPipe[i] = static_cast<float>(std::min(i, count - i));
        sawtooth[i] = static_cast<float>(i % 17);
    }
    for (const auto& depths : {rising, falling, organPipe, sawtooth})
        EXPECT_EQ(sorted(GetParam(), depths), stableSorted(depths));
}

TEST_P(DepthSortOf, OrdersPointsByDistanceFromTheEye) {
    const auto x = randomDepths(20'000, 1), y = randomDepths(20'000, 2), z = randomDepths(20'000, 3);
    const glm::vec3 eye(3, 2, -7);
    MemoryLedger ledger;
    DepthSort sort(ledger);
    const auto order = sort.farToNear(GetParam(), PointColumns{x, y, z}, eye);
    ASSERT_EQ(order.size(), x.size());
    std::vector<bool> seen(order.size(), false);
    double last = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : order) {
        EXPECT_FALSE(seen[i]);
        seen[i] = true;
        const double distance = glm::length(glm::dvec3(x[i], y[i], z[i]) - glm::dvec3(eye));
        EXPECT_LE(distance, last * (1 + 1e-6));
        last = distance;
    }
}

TEST_P(DepthSortOf, AllocatesNothingOnceWarm) {
    MemoryLedger ledger;
    DepthSort sort(ledger);
    (void)sort.farToNear(GetParam(), randomDepths(100'000, 1));
    const std::size_t bytes = ledger.totalBytes();
    EXPECT_LE(bytes, 100'000u * 24 + 131'072) << "24 bytes a point and the histograms";
    for (const std::size_t count : {90'000u, 100'000u, 5u, 110'000u}) {
        const auto depths = randomDepths(count, 2);
        const auto order = sort.farToNear(GetParam(), depths);
        EXPECT_EQ(Order(order.begin(), order.end()), stableSorted(depths));
        EXPECT_EQ(ledger.totalBytes(), bytes);
    }
}

TEST(DepthSort, IsTheSameAtAnyNumberOfThreads) {
    const auto depths = randomDepths(900'000, 11);
    const Order expected = stableSorted(depths);
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
    for (const int threads : {1, 2, 3, 8}) {
        tbb::task_arena arena(threads);
        arena.execute([&] { EXPECT_EQ(sorted(SortKind::radix, depths), expected) << threads; });
    }
}

TEST(DepthSort, NoneLeavesTheOrderAlone) {
    EXPECT_EQ(sorted(SortKind::none, {3, 1, 2}), (Order{0, 1, 2}));
}

TEST(DepthSort, RefusesColumnsOfDifferentLengths) {
    MemoryLedger ledger;
    DepthSort sort(ledger);
    const std::vector<float> three(3), two(2);
    EXPECT_THROW((void)sort.farToNear(SortKind::radix, PointColumns{three, three, two}, glm::vec3(0)),
                 std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::draw
