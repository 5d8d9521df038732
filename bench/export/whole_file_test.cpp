#include "bench/export/whole_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <fstream>
#include <iterator>

#include "bench/export/format_writers.h"
#include "bench/export/test_clouds.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::exports {
namespace {
namespace fs = std::filesystem;

std::string contentOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Simulates a full disk: during its lifetime no file of this process can grow beyond the given size.
class FullDisk {
 public:
    explicit FullDisk(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before_);
        formerly_ = signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        signal(SIGXFSZ, formerly_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

 private:
    rlimit before_{};
    sighandler_t formerly_ = nullptr;
};

TEST(WholeFile, AppearsOnlyWhenPublished) {
    const TestFolder folder;
    const fs::path place = folder.path() / "f.vti";
    {
        WholeFile file(place);
        std::ofstream(file.temporaryPath()) << "half";
        EXPECT_FALSE(fs::exists(place));
        EXPECT_TRUE(file.temporaryPath().filename().string().starts_with('.'));
        EXPECT_EQ(file.temporaryPath().parent_path(), place.parent_path());  // a rename within one file system
        std::ofstream(file.temporaryPath(), std::ios::app) << "and half";
        file.publish();
    }
    EXPECT_EQ(contentOf(place), "halfand half");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(WholeFile, AWriterThatThrowsMidwayLeavesTheOldFileAlone) {
    const TestFolder folder;
    const fs::path place = folder.write("f.vti", "old");
    EXPECT_THROW(
        {
            const WholeFile file(place);
            std::ofstream(file.temporaryPath()) << "half of the new";
            throw std::runtime_error("no more");
        },
        std::runtime_error);
    EXPECT_EQ(contentOf(place), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(WholeFile, WhatAKilledProgramLeftIsRemovedAndNothingElse) {
    const TestFolder folder;
    folder.write("f.vti", "x");
    folder.write(".hidden", "x");
    folder.write(".other.new", "x");
    std::ofstream(WholeFile(folder.path() / "g.vti").temporaryPath()) << "half";
    fs::create_directories(WholeFile(folder.path() / "g.vtm").temporaryPath() / "g");
    removeUnfinished(folder.path());
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder.path())) names.push_back(entry.path().filename());
    EXPECT_THAT(names, testing::UnorderedElementsAre("f.vti", ".hidden", ".other.new"));
}

template <typename Call>
std::string machineError(const Call& call) {
    try {
        call();
    } catch (const files::MachineError& error) {
        return error.what();
    }
    ADD_FAILURE() << "expected a MachineError";
    return "";
}

TEST(WholeFile, OnAFullDiskNoWriterLeavesAnything) {
    const TestFolder folder;
    const CollectedVolume volume = TestDust(500, 10, 0.3f, 1).volume();
    const ExtinctionGrid grid = computeGrid(volume, planGrid(volume.bounds(), 64));
    std::vector<std::string> messages;
    {
        const FullDisk full(20'000);
        messages = {machineError([&] { writeVti(grid, 0, folder.path() / "a.vti"); }),
                    machineError([&] { writeVdb(grid, VdbPrecision::half, 0, 0, folder.path() / "a.vdb"); }),
                    machineError([&] { writeWhole(folder.path() / "a.csv", std::string(30'000, 'x')); })};
    }
    EXPECT_THAT(messages, testing::Each(testing::HasSubstr("cannot be written")));
    EXPECT_TRUE(fs::is_empty(folder.path()));
    writeVti(grid, 0, folder.path() / "a.vti");
    EXPECT_GT(fs::file_size(folder.path() / "a.vti"), 20'000u);
}

TEST(WholeFile, AFolderThatIsNotThereIsNamed) {
    const TestFolder folder;
    const fs::path place = folder.path() / "nowhere" / "a";
    const ExtinctionGrid grid = computeGrid({}, planGrid({}, 1));
    for (const std::string& message : {inputError([&] { writeVti(grid, 0, place); }),
                                       inputError([&] { writeVdb(grid, VdbPrecision::half, 0, 0, place); }),
                                       inputError([&] { writeWhole(place, "x"); })})
        EXPECT_THAT(message, testing::HasSubstr(place.parent_path().string()));
}

}  // namespace
}  // namespace dustbench::exports
