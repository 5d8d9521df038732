#include "bench/results/method_facts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dustbench::results {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

MethodInfo methodWith(const ValidRange& valid) {
    MethodInfo method;
    method.facts = {{"clipped", "particles", FactOver::maximumOfFrames, "particles outside", {.maximum = 0}},
                    {"held", "share", FactOver::lastFrame, "share that is held", valid},
                    {"speed", "m/s", FactOver::lastFrame, "any value will do"}};
    return method;
}

TEST(Validity, NamesEachFactOutsideOfItsDeclaredRange) {
    const MethodInfo method = methodWith({.minimum = 0.9, .maximum = 1.1});
    EXPECT_THAT(whyInvalid(method, {{"clipped", std::int64_t{0}}, {"held", 1.0}, {"speed", -1e9}}, {}), IsEmpty());
    EXPECT_THAT(whyInvalid(method, {{"clipped", std::int64_t{12}}, {"held", 0.5}}, {}),
                ElementsAre("clipped is 12, allowed: up to 0", "held is 0.5, allowed: 0.9..1.1"));
    EXPECT_THAT(whyInvalid(methodWith({.minimum = 0.9}), {{"held", 0.5}}, {}),
                ElementsAre("held is 0.5, allowed: 0.9 or more"));
    // A fact that was not reported is not checked; one that is not a number is invalid.
    EXPECT_THAT(whyInvalid(method, {}, {}), IsEmpty());
    EXPECT_THAT(whyInvalid(method, {{"held", std::numeric_limits<double>::quiet_NaN()}}, {}), testing::SizeIs(1));
}

TEST(Validity, NamesANumberOfParticlesThatChanceDoesNotExplain) {
    for (const std::int64_t asked : {10, 500, 20000, 1000000}) {
        const double scatter = std::sqrt(static_cast<double>(asked));
        for (const double sign : {-1.0, 1.0}) {
            EXPECT_THAT(whyInvalid({}, {}, {asked, static_cast<double>(asked) + sign * 4.9 * scatter}), IsEmpty());
            EXPECT_THAT(whyInvalid({}, {}, {asked, static_cast<double>(asked) + sign * 5.1 * scatter}),
                        testing::SizeIs(1));
        }
    }
    EXPECT_THAT(whyInvalid({}, {}, {1000, 625}), ElementsAre("particles_median is 625, requested: 1000"));
    EXPECT_THAT(whyInvalid({}, {}, {0, 625}), IsEmpty());            // according to the speed
    EXPECT_THAT(whyInvalid({}, {}, {1000, 625, false}), IsEmpty());  // the method shows something else
}

}  // namespace
}  // namespace dustbench::results
