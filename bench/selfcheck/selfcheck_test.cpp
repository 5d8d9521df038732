// Puts faults between the program and the driver, and expects the self-check to name each of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/selfcheck/machine_checks.h"
#include "bench/selfcheck/picture_checks.h"
#include "bench/selfcheck/selfcheck_report.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/gpu/faulty_driver.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::selfcheck {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> namesOf(const std::vector<Check>& checks, Outcome outcome) {
    std::vector<std::string> names;
    for (const Check& check : checks)
        if (check.outcome == outcome) names.push_back(check.name);
    return names;
}

std::vector<std::string> failuresWith(const std::vector<Check>& checks) {
    return namesOf(checks, Outcome::failed);
}

TEST(DeviceChecks, PassOnThisDevice) {
    gpu::Device device;
    EXPECT_THAT(failuresWith(correctnessChecks(device)), IsEmpty());
}

TEST(DeviceChecks, NameADriverThatStoresFewerBits) {
    gpu::Device device;
    const gpu::FewerBits fault;
    EXPECT_THAT(failuresWith(correctnessChecks(device)), ElementsAre("float targets"));
}

TEST(DeviceChecks, NameADriverWhosePixelsAreNotNumbers) {
    gpu::Device device;
    const gpu::PoisonedTextures fault;
    EXPECT_THAT(failuresWith(correctnessChecks(device)),
                ElementsAre("blending order", "float targets", "half-float targets"));
}

TEST(DeviceChecks, NameADriverThatReordersInstances) {
    gpu::Device device;
    const gpu::ReversedInstances fault;
    EXPECT_THAT(failuresWith(correctnessChecks(device)), ElementsAre("blending order"));
}

TEST(DeviceChecks, NameADriverThatLosesWrites) {
    gpu::Device device;
    const gpu::LostWrites fault;
    EXPECT_THAT(failuresWith(correctnessChecks(device)), testing::Contains("barriers"));
}

TEST(DeviceChecks, NameATimerThatLies) {
    const auto problems = [](double factor) {
        gpu::Device device;
        const gpu::ScaledTimer fault(factor);
        const std::vector<Check> checks = correctnessChecks(device);
        std::vector<std::string> names = namesOf(checks, Outcome::attention);
        std::ranges::move(failuresWith(checks), std::back_inserter(names));
        return names;
    };
    EXPECT_THAT(problems(1), testing::Not(testing::Contains("timer queries")));
    EXPECT_THAT(problems(0.1), testing::Contains("timer queries"));
    EXPECT_THAT(problems(3), testing::Contains("timer queries"));
}

TEST(DeviceRates, ArePositiveAndDataCentreGpusAreNamed) {
    gpu::Device device;
    int calls = 0;
    const DeviceRates rates = measureRates(device, [&] { ++calls; });
    EXPECT_EQ(calls, 1);
    EXPECT_GT(rates.blendedGigapixels, 0);
    EXPECT_GT(rates.gigaflops, 0);
    EXPECT_GT(rates.copiedGigabytes, 0);
    EXPECT_GT(rates.fragmentShare, 0);
    DeviceRates dataCentre = rates;
    dataCentre.fragmentShare = 0.03;
    EXPECT_THAT(namesOf(rateChecks(dataCentre, false), Outcome::attention), ElementsAre("fragment shaders"));
    EXPECT_THAT(namesOf(rateChecks(dataCentre, true), Outcome::attention), IsEmpty());
}

TEST(GpuClockCheck, NamesAClockThatIsHeldDownOrFalls) {
    const measure::GpuClockReading high{1800, ""}, low{900, ""}, hot{900, "heat"};
    EXPECT_EQ(gpuClockCheck({low, high, high}).outcome, Outcome::ok);
    EXPECT_EQ(gpuClockCheck({high, low, high}).outcome, Outcome::attention);
    EXPECT_THAT(gpuClockCheck({low, hot, low}).note, HasSubstr("heat"));
    EXPECT_EQ(gpuClockCheck({}).measured, "not reported");
}

TEST(ThrottlingCheck, CountsEventsDuringTheCheck) {
    measure::Machine before, after;
    before.throttled = after.throttled = 7;
    EXPECT_EQ(throttlingCheck(before, after).outcome, Outcome::ok);
    after.throttled = 9;
    EXPECT_EQ(throttlingCheck(before, after).outcome, Outcome::attention);
    EXPECT_THAT(throttlingCheck(before, after).measured, HasSubstr("2"));
}

TEST(PlannedPictures, AreOneForEachMethodOfThisTreeAndHaveTheirFiles) {
    const auto folder = files::dataFolder() / "selfcheck";
    std::set<std::string> drawn;
    for (const PlannedPicture& picture : readPlannedPictures(folder / "pictures.toml")) {
        EXPECT_GT(picture.flipLimit, 0) << picture.name;
        drawn.insert(picture.spec.method);
        EXPECT_TRUE(picture.reference != PlannedPicture::Reference::kept ||
                    std::filesystem::exists(folder / (picture.name + ".png")))
            << picture.name;
    }
    EXPECT_GE(drawn.size(), 12u);
}

TEST(PlannedPictures, SayWhatIsWrongWithTheFile) {
    const TestFolder folder;
    const auto message = [&](const std::string& text) {
        return inputError([&] { (void)readPlannedPictures(folder.write("p.toml", "size = \"32x32\"\n" + text)); });
    };
    EXPECT_THAT(message("[[picture]]\nname = \"a\"\n"), HasSubstr("method"));
    EXPECT_THAT(message("[[picture]]\nname = \"a\"\nmethod = \"null_method\"\nflip = 2\n"), HasSubstr("flip"));
    EXPECT_THAT(message("[[picture]]\nname = \"a\"\nmethod = \"null_method\"\nflip = 0.1\nreference = \"x\"\n"),
                HasSubstr("reference"));
    const std::string one = "[[picture]]\nname = \"a\"\nmethod = \"null_method\"\nflip = 0.1\n";
    EXPECT_THAT(message(one + one), HasSubstr("'a' appears twice"));
    EXPECT_THAT(message(one + "parameters = { nonsense = 1 }\n"), HasSubstr("nonsense"));
}

TEST(PlannedPictures, OfAMissingMethodAreSkippedWithTheReason) {
    const TestFolder folder;
    const auto planned = readPlannedPictures(folder.write(
        "p.toml", "size = \"32x32\"\n[[picture]]\nname = \"a\"\nmethod = \"smoke_signals\"\nflip = 0.1\n"));
    ASSERT_EQ(planned.size(), 1u);
    EXPECT_THAT(planned[0].skip, HasSubstr("smoke_signals"));
}

TEST(SelfcheckJson, SaysWhetherAllPassed) {
    const auto passed = [](Outcome outcome) {
        return nlohmann::json::parse(
                   selfcheckJson({}, {{"a", Outcome::ok, "1", "1"}, {"b", outcome, "2", "3"}}))["passed"]
            .get<bool>();
    };
    EXPECT_TRUE(passed(Outcome::attention));
    EXPECT_FALSE(passed(Outcome::failed));
}

}  // namespace
}  // namespace dustbench::selfcheck
