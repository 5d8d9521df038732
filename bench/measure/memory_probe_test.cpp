#include "bench/measure/memory_probe.h"

#include <gtest/gtest.h>

#include <vector>

namespace dustbench::measure {

TEST(MemoryProbe, SeesMemoryThatIsTouchedAndKeepsThePeak) {
    constexpr std::int64_t size = 64 << 20;
    const std::int64_t before = residentBytes();
    ASSERT_GT(before, 0);
    {
        const std::vector<char> touched(size, 'x');
        ASSERT_EQ(touched.back(), 'x');
        EXPECT_GE(residentBytes(), before + size * 9 / 10);
    }
    EXPECT_GE(peakResidentBytes(), before + size * 9 / 10);
}

}  // namespace dustbench::measure
