#include "methods/kit/lanes/lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace dustbench::lanes {
namespace {

template <typename Vector>
class Lanes : public ::testing::Test {
 public:
    static constexpr std::size_t count = sizeof(Vector) / sizeof(float);
    using Numbers = std::array<float, count + 2>;

    static Numbers randomNumbers() {
        static std::mt19937 random(11);
        std::uniform_real_distribution<float> value(-1, 1);
        Numbers numbers{};
        std::ranges::generate(numbers, [&] { return value(random); });
        return numbers;
    }
};
using Widths = ::testing::Types<Float4, Float8, Float16>;
TYPED_TEST_SUITE(Lanes, Widths);

TYPED_TEST(Lanes, AreStoredAsTheyAreLoadedAndNothingBeside) {
    const auto from = this->randomNumbers();
    auto to = this->randomNumbers();
    const auto before = to;
    store(to.data() + 1, load<TypeParam>(from.data()));
    EXPECT_EQ(to.front(), before.front());
    EXPECT_EQ(to.back(), before.back());
    for (std::size_t i = 0; i < this->count; ++i) EXPECT_EQ(to[i + 1], from[i]);
}

TYPED_TEST(Lanes, AreBoundedOneByOne) {
    for (int round = 0; round < 100; ++round) {
        const auto a = this->randomNumbers(), b = this->randomNumbers();
        const auto x = load<TypeParam>(a.data()), bound = load<TypeParam>(b.data());
        const TypeParam low = atMost(x, bound), high = atLeast(x, bound);
        for (std::size_t i = 0; i < this->count; ++i) {
            EXPECT_EQ(low[i], std::min(a[i], b[i]));
            EXPECT_EQ(high[i], std::max(a[i], b[i]));
        }
    }
}

TYPED_TEST(Lanes, AreTheBoundWhereTheyAreNoNumber) {
    const auto lost = everywhere<TypeParam>(std::numeric_limits<float>::quiet_NaN());
    const auto bound = everywhere<TypeParam>(0.5f);
    const TypeParam low = atMost(lost, bound), high = atLeast(lost, bound);
    for (std::size_t i = 0; i < this->count; ++i) {
        EXPECT_EQ(low[i], 0.5f);
        EXPECT_EQ(high[i], 0.5f);
    }
}

TYPED_TEST(Lanes, HoldTheSameNumberEverywhereAndItsSign) {
    for (const float value : {0.0f, -0.0f, 3.25f, -1e30f, std::numeric_limits<float>::infinity()}) {
        const auto all = everywhere<TypeParam>(value);
        for (std::size_t i = 0; i < this->count; ++i) {
            EXPECT_EQ(all[i], value);
            EXPECT_EQ(std::signbit(all[i]), std::signbit(value));
        }
    }
}

TEST(LookUp, PicksFromOneTableAndFromTwoAndWraps) {
    Float16 first, second;
    for (int i = 0; i < 16; ++i) {
        first[i] = static_cast<float>(i);
        second[i] = static_cast<float>(16 + i);
    }
    for (int shift = 0; shift < 64; ++shift) {
        Int16 index;
        for (int i = 0; i < 16; ++i) index[i] = 7 * i + shift;
        const Float16 fromOne = lookUp(first, index), fromBoth = lookUp(first, second, index);
        for (int i = 0; i < 16; ++i) {
            EXPECT_EQ(fromOne[i], static_cast<float>(index[i] % 16));
            EXPECT_EQ(fromBoth[i], static_cast<float>(index[i] % 32));
        }
    }
}

}  // namespace
}  // namespace dustbench::lanes
