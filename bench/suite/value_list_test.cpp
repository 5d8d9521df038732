#include "bench/suite/value_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/contract/errors.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::suite {

using testing::ElementsAre;

TEST(ValueList, RangesIncludeTheirEnd) {
    EXPECT_THAT(expandValues("speed", "5:20:5"), ElementsAre("5", "10", "15", "20"));
    EXPECT_THAT(expandValues("speed", "0:10:4"), ElementsAre("0", "4", "8"));
    EXPECT_THAT(expandValues("speed", "3:1:-1"), ElementsAre("3", "2", "1"));
    EXPECT_THAT(expandValues("speed", "7:7:1"), ElementsAre("7"));
}

TEST(ValueList, RangesGiveTheNumbersAPersonWouldWrite) {
    EXPECT_THAT(expandValues("speed", "0.1:0.5:0.1"), ElementsAre("0.1", "0.2", "0.3", "0.4", "0.5"));
}

TEST(ValueList, ListsKeepTheirOrderAndMayHoldRanges) {
    EXPECT_THAT(expandValues("sort", "radix,none"), ElementsAre("radix", "none"));
    EXPECT_THAT(expandValues("particles", "10,100:300:100"), ElementsAre("10", "100", "200", "300"));
    EXPECT_THAT(expandValues("grid", "128x64x64"), ElementsAre("128x64x64"));
}

TEST(ValueList, AFileWhoseNameHasACommaIsOneValue) {
    const TestFolder folder;
    const std::string file = folder.write("v,ol.vti", "");
    EXPECT_THAT(expandValues("volume", file), ElementsAre(file));
    EXPECT_THAT(expandValues("volume", "a.vti," + file), ElementsAre("a.vti", testing::EndsWith("/v"), "ol.vti"));
}

TEST(ValueList, RefusesWhatIsNoListAndNoRange) {
    for (const char* text : {"1:2", "1:2:3:4", "1:x:2", "1:5:0", "1:5:-1", "1,,2", "", "0:1e9:1e-3"})
        EXPECT_THROW((void)expandValues("p", text), InputError) << text;
}

TEST(ValueList, StopsAtTheLimitOfPlannedRuns) {
    std::string text = "1:9999:1";
    for (int i = 0; i < 9; ++i) text += ",1:9999:1";
    EXPECT_EQ(expandValues("p", text).size(), 99'990u);
    try {
        (void)expandValues("p", text + ",1:9999:1");
        FAIL() << "nothing thrown";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("more than 100000 values"));
    }
}

}  // namespace dustbench::suite
