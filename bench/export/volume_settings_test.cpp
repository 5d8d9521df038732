#include "bench/export/exporter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/kit/testing/test_folder.h"

namespace dustbench::bench {
namespace {

using testing::HasSubstr;

TEST(VolumeSettings, FormatsAreASet) {
    EXPECT_EQ(formatsText(parseFormats("vdb,vti,htg,vti,vtp")), "vti,htg,vtp,vdb");
    EXPECT_EQ(formatsText(parseFormats("htg")), "htg");
    for (const char* text : {"", "vtk", "VTI", "vti,", ",vti", "vti;htg", "vti, htg"})
        EXPECT_THAT(inputError([&] { (void)parseFormats(text); }), HasSubstr("allowed: vti, htg, vtp, vdb")) << text;
}

TEST(VolumeSettings, AnOptionOfAFormatIsOneOfItsWordsAndNamedAtItsDefaultOnlyIfItAlwaysWas) {
    VolumeSettings settings;
    for (const ExporterOption& option : exporterOptions()) {
        EXPECT_EQ(settings.option(option.id), option.words.front());
        for (const std::string& word : option.words) {
            settings.setOption(option.id, word);
            EXPECT_EQ(settings.option(option.id), word);
        }
        EXPECT_THAT(inputError([&] { settings.setOption(option.id, "double"); }),
                    HasSubstr(option.words[0] + "|" + option.words[1]));
        settings.setOption(option.id, option.words.front());
    }
    EXPECT_EQ(settings.options.size(), 0u);
    EXPECT_THAT(settings.namedOptions(), testing::ElementsAre(testing::Pair("vdb_precision", "half")));
}

TEST(VolumeSettings, ARegionSurvivesItsText) {
    const Box box = parseRegion("-1.5,0,2e1,1,0.25,20.5");
    EXPECT_EQ(box.minimum, glm::dvec3(-1.5, 0, 20));
    EXPECT_EQ(box.maximum, glm::dvec3(1, 0.25, 20.5));
    EXPECT_EQ(parseRegion(regionText(box)).minimum, box.minimum);
    EXPECT_EQ(parseRegion(regionText(box)).maximum, box.maximum);
}

TEST(VolumeSettings, ARegionIsSixFiniteNumbersWithRoomBetween) {
    for (const char* text :
         {"", "1,2,3", "0,0,0,1,1,1,1", "0,0,0,1,1,x", "0,0,0,1,1,", "0,0,0,1,1,nan", "0,0,0,1,1,inf", "0,0,0,1,1,1e9",
          "0,0,0,0,1,1", "0,0,0,1,-1,1", "0,0,0,1,1,1e-9", "0:0:0:1:1:1"})
        EXPECT_THAT(inputError([&] { (void)parseRegion(text); }),
                    testing::AllOf(testing::StartsWith("region: got '" + std::string(text) + "'"),
                                   HasSubstr("expected x0,y0,z0,x1,y1,z1")))
            << text;
}

}  // namespace
}  // namespace dustbench::bench
