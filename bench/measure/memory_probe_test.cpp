#include "bench/measure/memory_probe.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <vector>

namespace dustbench::bench {

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

TEST(MemoryProbe, AvailableIsNoMoreThanTheProcesssOwnLimitLeaves) {
    const std::int64_t machine = availableBytes();
    EXPECT_GT(machine, 1 << 20);
    rlimit before{};
    getrlimit(RLIMIT_AS, &before);
    const rlimit tight{rlim_t{1} << 20, before.rlim_max};  // less than the process has already
    setrlimit(RLIMIT_AS, &tight);
    const std::int64_t left = availableBytes();
    setrlimit(RLIMIT_AS, &before);
    EXPECT_EQ(left, 0);
}

}  // namespace dustbench::bench
