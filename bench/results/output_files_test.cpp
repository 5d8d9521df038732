#include "bench/results/output_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "bench/measure/sha256.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::results {
namespace {
namespace fs = std::filesystem;

using testing::HasSubstr;

/// A run's folder with a table, a picture and files that are not outputs.
class OutputFiles : public testing::Test {
 protected:
    void SetUp() override {
        fs::create_directories(folder_.path() / "images");
        for (const char* name : {"run.json", "spec.json", "log.txt"}) folder_.write(name, "not an output");
        folder_.write("frames.csv", "frame\n0\n");
        folder_.write("images/f000000.png", std::string(3'000'000, 'p'));  // several blocks
    }

    TestFolder folder_;
};

TEST_F(OutputFiles, AreAllFilesOfTheRunWithTheirSums) {
    const std::vector<OutputFile> outputs = outputsIn(folder_.path());
    ASSERT_EQ(outputs.size(), 2u);
    EXPECT_EQ(outputs[0].file, "frames.csv");
    EXPECT_EQ(outputs[0].bytes, 8u);
    EXPECT_EQ(outputs[0].sha256, measure::sha256("frame\n0\n"));
    EXPECT_EQ(outputs[1].file, "images/f000000.png");
    EXPECT_EQ(outputs[1].sha256, measure::sha256(std::string(3'000'000, 'p')));
    EXPECT_EQ(whyAltered(outputs, folder_.path()), "");
    folder_.write("notes.txt", "somebody's notes");
    EXPECT_EQ(whyAltered(outputs, folder_.path()), "");
}

TEST_F(OutputFiles, AreMissedCutChangedAndReplacedByOtherThings) {
    const std::vector<OutputFile> outputs = outputsIn(folder_.path());
    folder_.write("frames.csv", "frame\n1\n");
    EXPECT_EQ(whyAltered(outputs, folder_.path()), "frames.csv was altered: its SHA-256 differs");
    folder_.write("frames.csv", "frame\n");
    EXPECT_EQ(whyAltered(outputs, folder_.path()), "frames.csv has 6 bytes, expected 8");
    fs::remove(folder_.path() / "frames.csv");
    EXPECT_EQ(whyAltered(outputs, folder_.path()), "frames.csv is missing");
    fs::create_symlink("/dev/zero", folder_.path() / "frames.csv");
    EXPECT_EQ(whyAltered(outputs, folder_.path()), "frames.csv is a symbolic link");
    fs::remove(folder_.path() / "frames.csv");
    ASSERT_EQ(mkfifo((folder_.path() / "frames.csv").c_str(), 0600), 0);
    EXPECT_EQ(whyAltered(outputs, folder_.path()), "frames.csv is not a regular file");
}

TEST_F(OutputFiles, OfManyTheLastByteCounts) {
    const std::vector<OutputFile> outputs = outputsIn(folder_.path());
    folder_.write("images/f000000.png", std::string(2'999'999, 'p') + "q");
    EXPECT_THAT(whyAltered(outputs, folder_.path()), HasSubstr("images/f000000.png was altered"));
}

TEST(OutputNames, StayBelowTheFolder) {
    for (const char* name : {"frames.csv", "images/f000000.png", "..a", ".hidden"}) EXPECT_TRUE(isWithin(name)) << name;
    for (const char* name : {"", ".", "..", "../a", "/etc/hostname", "a/../../b", "./a", "a//b"})
        EXPECT_FALSE(isWithin(name)) << name;
}

}  // namespace
}  // namespace dustbench::results
