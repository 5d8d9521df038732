#include "bench/measure/provenance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::measure {

TEST(Provenance, SaysHowAndWhenAndWhere) {
    const Provenance provenance = startProvenance({"dustbench", "run"});
    EXPECT_THAT(provenance.argv, testing::ElementsAre("dustbench", "run"));
    EXPECT_FALSE(provenance.build.compiler.empty());
    EXPECT_THAT(provenance.build.flags, testing::HasSubstr("-ffp-contract=off"));
    EXPECT_TRUE(std::regex_match(provenance.build.gitCommit, std::regex("([0-9a-f]{40})?")));
    EXPECT_TRUE(std::regex_match(provenance.startedUtc, std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ)")));
    EXPECT_GE(provenance.machine.cores, 1);
    EXPECT_GT(provenance.machine.ramBytes, 1 << 20);
    EXPECT_FALSE(provenance.machine.kernel.empty());
    EXPECT_TRUE(std::regex_match(provenance.build.buildId, std::regex("([0-9a-f]{8,})?")));
}

TEST(Provenance, NamesWhatOfTheEnvironmentChangesDrawingOrThreads) {
    const char* const variables[]{"PATH=/bin",  "TBB_MALLOC_USE_HUGE_PAGES=1", "LP_NUM_THREADS=7",
                                  "HOME=/root", "mesa_glthread=true",          "LIBGL_ALWAYS_SOFTWARE=1",
                                  "HELP_=LP_",  "GALLIUM_DRIVER=llvmpipe",     nullptr};
    EXPECT_EQ(drawingEnvironment(variables),
              "GALLIUM_DRIVER=llvmpipe LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=7 TBB_MALLOC_USE_HUGE_PAGES=1 "
              "mesa_glthread=true");
    EXPECT_EQ(drawingEnvironment(nullptr), "");
}

TEST(Provenance, WarnsOfAllThatDisturbs) {
    Machine machine;
    machine.cores = 4;
    EXPECT_THAT(disturbances(machine), testing::IsEmpty());
    machine.governor = "performance";
    EXPECT_THAT(disturbances(machine), testing::IsEmpty());
    machine.governor = "powersave";
    machine.loadAverage = 3;
    EXPECT_THAT(disturbances(machine),
                testing::ElementsAre(testing::HasSubstr("powersave"), testing::HasSubstr("3.00 on 4 cores")));
    machine = Machine();
    machine.cores = 4;
    machine.quotaCores = 1.5;
    machine.stolenShare = 0.02;
    machine.throttled = 7;
    EXPECT_THAT(disturbances(machine),
                testing::ElementsAre(testing::HasSubstr("1.50 cores but sees 4"), testing::HasSubstr("2.0 %"),
                                     testing::HasSubstr("7 times")));
}

TEST(Provenance, NamesInputsByTheirContent) {
    const TestFolder folder;
    const auto file = folder.write("input.txt", "abc");
    const auto hashes = hashInputs({file});
    ASSERT_EQ(hashes.size(), 1u);
    EXPECT_EQ(hashes[0].file, file.generic_string());
    EXPECT_EQ(hashes[0].sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(hashInputs({files::dataFolder() / "suites" / "x.toml"})[0].file, "suites/x.toml");
}

}  // namespace dustbench::measure
