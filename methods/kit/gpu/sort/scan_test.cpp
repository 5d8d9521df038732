// Tests sums, compaction and reductions against the standard library.
#include "methods/kit/gpu/sort/scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace dustbench::gpu {
namespace {

using Numbers = std::vector<std::uint32_t>;

Device& scanningDevice() {
    static Device one;
    return one;
}

template <typename T>
Buffer filled(const std::vector<T>& numbers) {
    Buffer buffer(scanningDevice(), "test", std::max<std::size_t>(numbers.size(), 1) * sizeof(T));
    buffer.write(std::span<const T>(numbers));
    return buffer;
}

template <typename T>
std::vector<T> contents(const Buffer& buffer, std::size_t count) {
    std::vector<T> numbers(count);
    buffer.read(std::span<T>(numbers));
    return numbers;
}

std::vector<std::size_t> sizesToScan() {
    std::vector<std::size_t> sizes{0,     1,     2,           255,    256,     257,       1'000,      2'047,
                                   2'048, 2'049, 2'048 * 256, 10'000, 100'000, 1'000'000, 2'048 * 600};
    if (std::getenv("DUSTBENCH_FULL_SIZE")) sizes.push_back(10'000'000);
    return sizes;
}

/// `maximum`: largest number, all of which appear.
Numbers randomNumbers(std::size_t count, std::uint32_t maximum = ~0u) {
    std::mt19937 random(static_cast<std::uint32_t>(count) + 1);
    std::uniform_int_distribution<std::uint32_t> uniform(0, maximum);
    Numbers numbers(count);
    std::ranges::generate(numbers, [&] { return uniform(random); });
    return numbers;
}

/// Sums overflow and wrap around, as unsigned numbers do.
TEST(GpuScan, EqualsTheStandardInclusiveScanForEverySize) {
    InclusiveScan scan(scanningDevice(), static_cast<std::uint32_t>(sizesToScan().back()));
    for (const std::size_t count : sizesToScan())
        for (const Numbers& numbers : {randomNumbers(count), Numbers(count, 1)}) {
            Numbers expected(count);
            std::inclusive_scan(numbers.begin(), numbers.end(), expected.begin());
            const Buffer elements = filled(numbers);
            Buffer sums = filled(Numbers(count));
            scan.scan(elements, sums, static_cast<std::uint32_t>(count));
            ASSERT_TRUE(contents<std::uint32_t>(sums, count) == expected) << count;
        }
}

TEST(GpuScan, MayReplaceItsElements) {
    const Numbers numbers = randomNumbers(9'999);
    Numbers expected(numbers.size());
    std::inclusive_scan(numbers.begin(), numbers.end(), expected.begin());
    Buffer buffer = filled(numbers);
    InclusiveScan(scanningDevice(), 10'000).scan(buffer, buffer, 9'999u);
    EXPECT_EQ(contents<std::uint32_t>(buffer, numbers.size()), expected);
}

TEST(GpuCompaction, EqualsTheStandardCopyIfForEverySize) {
    Compaction compaction(scanningDevice(), static_cast<std::uint32_t>(sizesToScan().back()));
    for (const std::size_t count : sizesToScan())
        for (const std::uint32_t maximum : {0u, 1u, 2u, ~0u}) {
            const Numbers values = randomNumbers(count), flags = randomNumbers(count, maximum);
            Numbers expected;
            for (std::size_t i = 0; i < count; ++i)
                if (flags[i] != 0) expected.push_back(values[i]);
            Buffer kept = filled(Numbers(count)), keptCount = filled(Numbers(1, 77));
            compaction.compact(filled(values), filled(flags), static_cast<std::uint32_t>(count), kept, keptCount);
            ASSERT_EQ(contents<std::uint32_t>(keptCount, 1).front(), expected.size()) << count;
            ASSERT_TRUE(contents<std::uint32_t>(kept, expected.size()) == expected) << count << ' ' << maximum;
        }
}

/// The number of kept values stays on the GPU and limits the next step there.
TEST(GpuCompaction, HandsItsCountToTheNextStep) {
    constexpr std::uint32_t count = 50'000;
    const Numbers values = randomNumbers(count, 9), flags = randomNumbers(count, 2);
    Numbers expected;
    for (std::size_t i = 0; i < count; ++i)
        if (flags[i] != 0) expected.push_back(values[i]);
    std::inclusive_scan(expected.begin(), expected.end(), expected.begin());
    Buffer kept = filled(Numbers(count)), keptCount = filled(Numbers(1)), sums = filled(Numbers(count, 123));
    Compaction(scanningDevice(), count).compact(filled(values), filled(flags), count, kept, keptCount);
    InclusiveScan(scanningDevice(), count).scan(kept, sums, keptCount);
    Numbers found = contents<std::uint32_t>(sums, count);
    EXPECT_EQ(found[expected.size()], 123u);
    found.resize(expected.size());
    EXPECT_EQ(found, expected);
}

template <typename T>
T reduced(Reduction& reduction, const std::vector<T>& numbers) {
    Buffer result = filled(std::vector<T>(1, T{55}));
    reduction.reduce(filled(numbers), static_cast<std::uint32_t>(numbers.size()), result);
    return contents<T>(result, 1).front();
}

TEST(GpuReduction, EqualsTheStandardReduceForEverySize) {
    const auto capacity = static_cast<std::uint32_t>(sizesToScan().back());
    Reduction sum(scanningDevice(), capacity, Reduce::sum, Number::uint32);
    Reduction minimum(scanningDevice(), capacity, Reduce::minimum, Number::uint32);
    Reduction maximum(scanningDevice(), capacity, Reduce::maximum, Number::uint32);
    for (const std::size_t count : sizesToScan()) {
        const Numbers numbers = randomNumbers(count);
        ASSERT_EQ(reduced(sum, numbers), std::reduce(numbers.begin(), numbers.end())) << count;
        ASSERT_EQ(reduced(minimum, numbers), count == 0 ? ~0u : std::ranges::min(numbers)) << count;
        ASSERT_EQ(reduced(maximum, numbers), count == 0 ? 0u : std::ranges::max(numbers)) << count;
    }
}

/// A sum of n floats in a tree: its error grows with log n, here bounded by 32 roundings of the sum of magnitudes.
TEST(GpuReduction, OfFloatsIsExactForExtremesAndCloseForSums) {
    const auto capacity = static_cast<std::uint32_t>(sizesToScan().back());
    Reduction sum(scanningDevice(), capacity, Reduce::sum, Number::float32);
    Reduction minimum(scanningDevice(), capacity, Reduce::minimum, Number::float32);
    Reduction maximum(scanningDevice(), capacity, Reduce::maximum, Number::float32);
    const float infinity = std::numeric_limits<float>::infinity();
    for (const std::size_t count : sizesToScan()) {
        std::mt19937 random(static_cast<std::uint32_t>(count));
        std::uniform_real_distribution<float> uniform(-1, 2);
        std::vector<float> numbers(count);
        std::ranges::generate(numbers, [&] { return uniform(random); });
        double exact = 0, magnitudes = 0;
        for (const float number : numbers)
            exact += static_cast<double>(number), magnitudes += std::abs(static_cast<double>(number));
        const float found = reduced(sum, numbers);
        ASSERT_NEAR(static_cast<double>(found), exact, 32 * 0x1p-24 * magnitudes) << count;
        ASSERT_EQ(reduced(sum, numbers), found) << count;
        ASSERT_EQ(reduced(minimum, numbers), count == 0 ? infinity : std::ranges::min(numbers)) << count;
        ASSERT_EQ(reduced(maximum, numbers), count == 0 ? -infinity : std::ranges::max(numbers)) << count;
    }
}

}  // namespace
}  // namespace dustbench::gpu
