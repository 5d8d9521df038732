#include "bench/measure/steadiness.h"

#include <gmock/gmock.h>

#include <random>

namespace dustbench::measure {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<double> normalTimes(std::size_t count, double mean, double deviation, std::mt19937& random) {
    std::normal_distribution<double> noise(mean, deviation);
    std::vector<double> times;
    for (std::size_t i = 0; i < count; ++i) times.push_back(std::max(0.1, noise(random)));
    return times;
}

TEST(Steadiness, SteadyTimesAreLeftAlone) {
    std::mt19937 random(5);
    int warned = 0;
    for (int round = 0; round < 400; ++round)
        for (const double deviation : {0.1, 1.0, 2.0})
            warned += steadinessWarnings(normalTimes(120, 20, deviation, random)).empty() ? 0 : 1;
    EXPECT_LE(warned, 6);  // of 1200
    EXPECT_THAT(steadinessWarnings(std::vector<double>(100, 16.5)), IsEmpty());
    EXPECT_THAT(steadinessWarnings({}), IsEmpty());
    EXPECT_THAT(steadinessWarnings(std::vector<double>{3}), IsEmpty());
}

TEST(Steadiness, AnEvenSpreadIsNoDriftAndNotTwoSpeeds) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform(10, 14);
    int warned = 0;
    for (int round = 0; round < 300; ++round) {
        std::vector<double> times(200);
        for (double& time : times) time = uniform(random);
        warned += steadinessWarnings(times).empty() ? 0 : 1;
    }
    EXPECT_LE(warned, 3);
}

TEST(Steadiness, SaysThatTheWarmUpHadNotEnded) {
    std::mt19937 random(7);
    for (int round = 0; round < 50; ++round) {
        std::vector<double> times = normalTimes(120, 20, 1, random);
        for (std::size_t i = 0; i < 14; ++i) times[i] += 6;
        EXPECT_THAT(steadinessWarnings(times), testing::Contains(HasSubstr("warm-up had not ended")));
    }
}

TEST(Steadiness, SaysThatTimesDriftAndWhichWay) {
    std::mt19937 random(8);
    for (const double change : {0.3, -0.3}) {
        std::vector<double> times = normalTimes(300, 20, 0.8, random);
        for (std::size_t i = 0; i < times.size(); ++i) times[i] *= 1 + change * static_cast<double>(i) / 300;
        EXPECT_THAT(steadinessWarnings(times),
                    testing::Contains(AllOf(HasSubstr("drift"), HasSubstr(change > 0 ? "+2" : "-3"))));
    }
}

TEST(Steadiness, SaysThatThereAreTwoSpeeds) {
    std::mt19937 random(9);
    std::vector<double> times = normalTimes(200, 10, 0.3, random);
    for (std::size_t i = 0; i < times.size(); ++i)
        if (random() % 3 == 0) times[i] += 4;
    EXPECT_THAT(steadinessWarnings(times), ElementsAre(AllOf(HasSubstr("two speeds"), HasSubstr("14"))));
}

TEST(Steadiness, NamesStallsAndTheLongest) {
    std::mt19937 random(10);
    std::vector<double> times = normalTimes(100, 10, 0.3, random);
    times[31] = 40;
    times[77] = 95;
    EXPECT_THAT(steadinessWarnings(times),
                ElementsAre(AllOf(HasSubstr("2 of 100 frames stalled"), HasSubstr("frame 77 took 95 ms"))));
    EXPECT_THAT(steadinessWarnings(std::vector<double>{10, 10, 11, 50}), ElementsAre(HasSubstr("1 of 4 frames")));
}

TEST(Steadiness, TakesLongRunsInTime) {
    std::mt19937 random(11);
    EXPECT_THAT(steadinessWarnings(normalTimes(200'000, 16, 0.5, random)), IsEmpty());
}

}  // namespace
}  // namespace dustbench::measure
