#include "methods/contract/choices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/kit/testing/test_input_error.h"

namespace dustbench {
namespace {

enum class Metal { tin, iron, lead };
constexpr Choices<Metal> metals{{"lead", Metal::lead}, {"tin", Metal::tin}};

TEST(Choices, KeepTheOrderOfTheTableNotThatOfTheEnumeration) {
    EXPECT_EQ(metals.words(), (std::vector<std::string>{"lead", "tin"}));
}

TEST(Choices, WordsAndEnumeratorsStandForEachOther) {
    EXPECT_EQ(metals.wordOf(Metal::lead), "lead");
    EXPECT_EQ(metals.find("tin"), Metal::tin);
    for (const auto& [word, metal] : metals.all()) {
        EXPECT_EQ(metals.wordOf(metal), word);
        EXPECT_EQ(metals.valueOf(word), metal);
        EXPECT_EQ(metals.parse("metal", word), metal);
    }
}

TEST(Choices, RefuseWhatIsNotInTheTable) {
    EXPECT_EQ(metals.find("iron"), std::nullopt);
    EXPECT_EQ(inputError([] { (void)metals.parse("metal", "iron"); }), "metal: got 'iron', allowed: lead|tin");
    EXPECT_THROW((void)metals.valueOf("iron"), std::logic_error);
    EXPECT_THROW((void)metals.wordOf(Metal::iron), std::logic_error);
}

}  // namespace
}  // namespace dustbench
