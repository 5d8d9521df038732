#include "bench/results/run_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "bench/world/world.h"
#include "methods/contract/registry.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::results {
namespace {

MethodInfo haze() {
    MethodInfo info;
    info.id = "haze";
    info.parameters.real("thickness", 0.5, 0, 1, "", "how thick").choice("mode", "soft", {"soft", "hard"}, "which");
    return info;
}

TEST(RunSpec, IdDoesNotDependOnOrderOrSpellingOfParameters) {
    RunSpec a, b;
    a.method = b.method = "haze";
    a.parameters = canonicalParameters(haze(), {{"mode", "hard"}, {"thickness", "0.50"}});
    b.parameters = canonicalParameters(haze(), {{"thickness", ".5"}, {"mode", "hard"}});
    EXPECT_EQ(runId(a), runId(b));
    // An explicit default gives the same run id as an omitted one.
    b.parameters = canonicalParameters(haze(), {{"mode", "hard"}});
    EXPECT_EQ(runId(a), runId(b));
}

TEST(RunSpec, EveryFieldTellsRunsApart) {
    RunSpec base;
    base.method = "haze";
    base.parameters = canonicalParameters(haze(), {});
    std::vector<RunSpec> specs(21, base);
    specs[1].method = "mist";
    specs[2].scene = "hills";
    specs[3].drive = "slalom";
    specs[4].parameters = canonicalParameters(haze(), {{"mode", "hard"}});
    specs[5].frames = 7;
    specs[6].warmup = 7;
    specs[7].size = {32, 24};
    specs[8].seed = 7;
    specs[9].threads = 1;
    specs[10].sync = Sync::stage;
    specs[11].imagesEvery = 60;
    specs[12].repetition = 2;
    for (std::size_t i = 13; i < 19; ++i) specs[i].volumes.emplace();
    specs[14].volumes->frames = {0, 8, 4};
    specs[15].volumes->formats = {"vti", "vtp"};
    specs[16].volumes->resolution = 64;
    specs[17].volumes->region = exports::Box{{0, 0, 0}, {1, 2, 3}};
    specs[18].volumes->setOption("vdb_precision", "float");
    specs[19].dustOn = DustOn::cpu;
    specs[20].dustOn = DustOn::gpu;
    std::set<std::string> ids;
    for (const RunSpec& spec : specs) ids.insert(runId(spec));
    EXPECT_EQ(ids.size(), specs.size());
}

TEST(RunSpec, VolumesOfFramesThatAreNotRecordedAreRefused) {
    RunSpec spec;
    spec.frames = 9;
    EXPECT_NO_THROW(requireFramesWithinRun(spec));
    spec.volumes.emplace().frames = {0, 8, 4};
    EXPECT_NO_THROW(requireFramesWithinRun(spec));
    spec.frames = 8;
    EXPECT_THAT(inputError([&] { requireFramesWithinRun(spec); }),
                testing::AllOf(testing::HasSubstr("frame 8"), testing::HasSubstr("0..7")));
}

TEST(RunSpec, ARunWithoutVolumesSaysNothingOfThem) {
    EXPECT_THAT(canonicalKey(RunSpec()), testing::Not(testing::HasSubstr("volume")));
}

TEST(RunSpec, IdIsThatOfBuildsWithoutALaterParameter) {
    RunSpec today, before;
    today.parameters = {{"particles", "100"}, {"puffs_per_metre", "0"}};
    before.parameters = {{"particles", "100"}};
    EXPECT_EQ(runId(today), runId(before));
    today.parameters["puffs_per_metre"] = "2.5";
    EXPECT_NE(runId(today), runId(before));
    EXPECT_TRUE(isLaterDefault("puffs_per_metre", world::worldParameters().find("puffs_per_metre")->initial));
}

TEST(RunSpec, IdIsAReadablePlainFolderName) {
    RunSpec spec;
    spec.method = "haze";
    spec.scene = "/some/where/my scene.toml";
    spec.drive = "slalom";
    EXPECT_THAT(runId(spec), testing::MatchesRegex("haze-myscene-slalom-r1-[0-9a-f]+"));
}

TEST(RunSpec, UnknownParameterNamesTheNearestOfMethodAndWorld) {
    EXPECT_THAT(inputError([] {
                    (void)resolveParameters(haze(), {{"thicknes", "1"}});
                }),
                testing::HasSubstr("did you mean 'thickness'"));
    const std::string worlds = world::worldParameters().all().front().name;
    EXPECT_THAT(inputError([&] {
                    (void)resolveParameters(haze(), {{worlds + "x", "1"}});
                }),
                testing::HasSubstr("did you mean '" + worlds + "'"));
}

TEST(RunSpec, ValueOutOfRangeSaysTheRange) {
    EXPECT_THAT(inputError([] {
                    (void)resolveParameters(haze(), {{"thickness", "2"}});
                }),
                testing::AllOf(testing::HasSubstr("thickness"), testing::HasSubstr("'2'"), testing::HasSubstr("0..1")));
}

TEST(RunSpec, NoMethodRedeclaresAParameterOfTheWorld) {
    for (const MethodInfo& method : methods())
        for (const Parameter& parameter : method.parameters.all())
            EXPECT_EQ(world::worldParameters().find(parameter.name), nullptr) << method.id << ": " << parameter.name;
}

TEST(RunSpec, SizeIsWidthByHeight) {
    EXPECT_EQ(parseSize("800x600").width, 800);
    EXPECT_EQ(parseSize("800x600").height, 600);
    for (const char* text : {"800", "800x", "x600", "0x5", "800x600x3", "800X600", "-1x5", "99999x1", ""})
        EXPECT_THROW((void)parseSize(text), InputError) << text;
}

TEST(RunSpec, SyncIsOneOfThree) {
    for (const Sync sync : {Sync::frame, Sync::stage, Sync::none})
        EXPECT_EQ(syncs.parse("sync", syncs.wordOf(sync)), sync);
    EXPECT_THROW((void)syncs.parse("sync", "always"), InputError);
}

}  // namespace
}  // namespace dustbench::results
