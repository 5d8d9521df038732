#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "bench/suite/suite.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

using testing::HasSubstr;

std::string givenTwice(const std::string& text) {
    try {
        (void)parseSuite(text, "s.toml", false);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing thrown";
}

TEST(GivenTwice, IsRefusedInWhateverForm) {
    const std::string billboard = "methods = [\"billboard\"]\n";
    EXPECT_THAT(givenTwice("methods = [\"billboard\", \"null_method\", \"billboard\"]"),
                HasSubstr("s.toml:1: key 'methods': billboard is given twice"));
    EXPECT_THAT(givenTwice(billboard + "sizes = [\"64x48\", \"80x60\", \"64x48\"]"),
                HasSubstr("s.toml:2: key 'sizes': 64x48 is given twice"));
    EXPECT_THAT(givenTwice(billboard + "scenes = [\"plain\", \"plain\"]"), HasSubstr("plain is given twice"));
    EXPECT_THAT(givenTwice(billboard + "drives = [\"straight\", \"straight\"]"), HasSubstr("straight is given twice"));
    const auto values = [&](const std::string& list) {
        return givenTwice(billboard + "[parameters]\nparticles = [" + list + "]");
    };
    EXPECT_THAT(values("200, 400, 200"), HasSubstr("s.toml:3: parameter particles: 200 is given twice"));
    for (const char* form : {"\"100\"", "100.0", "\"100:300:100\""})
        EXPECT_THAT(values(std::string("100, ") + form), HasSubstr("is given twice")) << form;
    EXPECT_THAT(givenTwice(billboard + "[method.billboard]\npreroll = [1, 1.0]"), HasSubstr("is given twice"));
    EXPECT_EQ(values("100, 101, 200"), "nothing thrown");
}

}  // namespace
}  // namespace dustbench::bench
