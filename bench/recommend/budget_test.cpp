#include "bench/recommend/budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

TEST(Budget, IsATimeWithItsUnit) {
    EXPECT_DOUBLE_EQ(parseBudget("--budget", "4ms").ms, 4);
    EXPECT_DOUBLE_EQ(parseBudget("--budget", "4 ms").ms, 4);
    EXPECT_DOUBLE_EQ(parseBudget("--budget", "0.25ms").ms, 0.25);
}

TEST(Budget, OfARateIsTheWholeFrame) {
    EXPECT_DOUBLE_EQ(parseBudget("--budget", "50fps").ms, 20);
    EXPECT_DOUBLE_EQ(parseBudget("--budget", "50 fps").ms, 20);
}

TEST(Budget, ThatIsNoneIsRefusedByName) {
    for (const char* text : {"", "4", "ms", "-4ms", "0ms", "0fps", "4s", "4 ms ms", "nanms", "1e9ms", "4,5ms"}) try {
            (void)parseBudget("--budget", text);
            ADD_FAILURE() << text;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::StartsWith(std::string("--budget: got '") + text + "', allowed:"));
        }
}

}  // namespace
}  // namespace dustbench::bench
