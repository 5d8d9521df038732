#include "bench/export/volume_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/export/exporter.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::exports {
namespace {

using testing::HasSubstr;

std::vector<std::int64_t> framesOf(const std::string& text) {
    const FrameRange range = parseFrameRange("--frames", text);
    std::vector<std::int64_t> frames;
    for (std::int64_t frame = 0; frame < 100; ++frame)
        if (range.contains(frame)) frames.push_back(frame);
    EXPECT_EQ(range.count(), static_cast<std::int64_t>(frames.size())) << text;
    EXPECT_EQ(range.last, frames.back()) << text;
    return frames;
}

TEST(FrameRange, LeavesOutItsEnd) {
    EXPECT_THAT(framesOf("0:10:5"), testing::ElementsAre(0, 5));
    EXPECT_THAT(framesOf("0:11:5"), testing::ElementsAre(0, 5, 10));
    EXPECT_THAT(framesOf("3:6"), testing::ElementsAre(3, 4, 5));
    EXPECT_THAT(framesOf("7"), testing::ElementsAre(7));
    EXPECT_THAT(framesOf("7:8:1000"), testing::ElementsAre(7));
}

TEST(FrameRange, HasOneTextForTheSameFrames) {
    EXPECT_EQ(parseFrameRange("", "0:10:4").text(), parseFrameRange("", "0:9:4").text());
    EXPECT_EQ(parseFrameRange("", "5").text(), parseFrameRange("", "5:7:9").text());
    for (const char* text : {"0:10:5", "3:6", "7", "2:90:11"}) {
        const FrameRange range = parseFrameRange("", text);
        EXPECT_EQ(framesOf(range.text()), framesOf(text));
    }
}

TEST(FrameRange, RefusesWhatHoldsNoFrameInOneLine) {
    for (const char* text : {"", "a", "1:", ":5", "1:5:", "1:2:3:4", "-1", "-5:5", "1:-5", "5:1", "5:1:2", "5:5",
                             "0:5:0", "0:5:-1", "1.5", "1 :5", "0:99999999999", "99999999999999999999", "0x10"})
        EXPECT_THAT(inputError([&] { (void)parseFrameRange("--frames", text); }),
                    testing::AllOf(testing::StartsWith("--frames: got '" + std::string(text) + "'"),
                                   testing::HasSubstr("allowed: A:B:STEP")))
            << text;
}

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
}  // namespace dustbench::exports
