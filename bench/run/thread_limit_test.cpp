#include "bench/run/thread_limit.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace dustbench::bench {
namespace {

TEST(ThreadLimit, ReplacesThatOfTheEnvironmentForTheRasteriser) {
    const auto limitWith = [](int threads) {
        setenv("LP_NUM_THREADS", "7", 1);
        std::string limit;
        withThreads(threads, [&] { limit = std::getenv("LP_NUM_THREADS"); });
        unsetenv("LP_NUM_THREADS");
        return limit;
    };
    EXPECT_EQ(limitWith(1), "1");
    EXPECT_EQ(limitWith(2), "2");
    EXPECT_EQ(limitWith(0), "7");  // no limit requested
}

}  // namespace
}  // namespace dustbench::bench
