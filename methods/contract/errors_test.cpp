#include "methods/contract/errors.h"

#include <gtest/gtest.h>

#include <vector>

namespace dustbench {
namespace {

const std::vector<std::string> known{"sort", "puff", "soft", "particles", "octree_search"};

TEST(NearestName, ForgivesOneLetterLeftOutPutInChangedOrSwapped) {
    for (const char* got : {"sotr", "srt", "sorrt", "sorb"}) EXPECT_EQ(nearestName(got, known), "sort") << got;
    EXPECT_EQ(nearestName("particels", known), "particles");
}

TEST(NearestName, TakesABeginningForTheWhole) {
    EXPECT_EQ(nearestName("oct", known), "octree_search");
}

TEST(NearestName, IsEmptyWhereNothingIsNear) {
    for (const char* got : {"", "xyz", "velocity"}) EXPECT_EQ(nearestName(got, known), "") << got;
}

TEST(UnknownName, SaysKindGotNearestAndKnown) {
    EXPECT_STREQ(unknownName("parameter", "sotr", std::vector<std::string>{"sort", "soft"}).what(),
                 "unknown parameter 'sotr' (did you mean 'sort'?); known: sort, soft");
    EXPECT_STREQ(unknownName("method", "x", {}).what(), "unknown method 'x'; known: none");
}

}  // namespace
}  // namespace dustbench
