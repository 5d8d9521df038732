#include "methods/contract/facts.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace dustbench {
namespace {

const std::vector<FactInfo> declared{{"clipped", "", FactOver::maximumOfFrames, "particles outside"},
                                     {"mass_kept", "", FactOver::lastFrame, "share of the mass"}};

TEST(Facts, AreKeptOfTheMomentsThatTheyAreDeclaredFor) {
    Facts ofFrame(declared, FactOver::maximumOfFrames);
    EXPECT_TRUE(ofFrame.wants("clipped"));
    EXPECT_FALSE(ofFrame.wants("mass_kept"));
    ofFrame.set("clipped", std::int64_t{7});
    ofFrame.set("mass_kept", 0.5);
    EXPECT_EQ(ofFrame.value("clipped"), FactValue(std::int64_t{7}));
    EXPECT_EQ(ofFrame.value("mass_kept"), std::nullopt);

    Facts atEnd(declared, FactOver::lastFrame);
    EXPECT_FALSE(atEnd.wants("clipped"));
    EXPECT_EQ(atEnd.value("mass_kept"), std::nullopt) << "not told yet";
    atEnd.set("mass_kept", 0.5);
    EXPECT_EQ(atEnd.value("mass_kept"), FactValue(0.5));
    atEnd.clear();
    EXPECT_EQ(atEnd.value("mass_kept"), std::nullopt);
}

TEST(Facts, RefuseWhatWasNotDeclared) {
    Facts facts(declared, FactOver::lastFrame);
    EXPECT_THROW(facts.set("mass_lost", 0.5), std::logic_error);
    EXPECT_THROW(static_cast<void>(facts.wants("mass_lost")), std::logic_error);
}

}  // namespace
}  // namespace dustbench
