#include "methods/kit/files/data_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "methods/kit/files/shipped_folder.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::files {
namespace fs = std::filesystem;
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class DataFolders : public testing::Test {
 public:
    ~DataFolders() override { before_ ? setenv("DUSTBENCH_DATA", before_->c_str(), 1) : unsetenv("DUSTBENCH_DATA"); }

 protected:
    DataFolders() {
        if (const char* before = std::getenv("DUSTBENCH_DATA")) before_ = before;
        unsetenv("DUSTBENCH_DATA");
    }
    /// A file in the data folder `name`.
    [[nodiscard]] fs::path add(const std::string& name, const std::string& file) const {
        fs::create_directories((folder_.path() / name / file).parent_path());
        return folder_.write(name + "/" + file, "x");
    }
    [[nodiscard]] std::string at(const std::string& name) const { return (folder_.path() / name).string(); }

    TestFolder folder_;

 private:
    std::optional<std::string> before_;
};

TEST_F(DataFolders, AddNamesAndTheFirstThatHasANameWins) {
    const fs::path mine = add("mine", "scenes/plain.toml"), both = add("mine", "scenes/hills.toml");
    const fs::path others = add("theirs", "scenes/hills.toml"), alone = add("theirs", "scenes/lake.toml");
    useDataFolders("--data", {at("mine"), at("theirs")});
    EXPECT_EQ(findData("scene", "scenes", "plain", ".toml"), mine);
    EXPECT_EQ(findData("scene", "scenes", "hills", ".toml"), both);
    EXPECT_EQ(findData("scene", "scenes", "lake", ".toml"), alone);
    EXPECT_EQ(findData("scene", "scenes", "dunes", ".toml"), dataFolder() / "scenes" / "dunes.toml");
    EXPECT_THAT(listData("scenes", ".toml"),
                AllOf(testing::IsSupersetOf({"plain", "hills", "lake", "dunes"}),
                      testing::WhenSorted(testing::ElementsAreArray(listData("scenes", ".toml")))));
    EXPECT_THAT(inputError([] { (void)findData("scene", "scenes", "lak", ".toml"); }), HasSubstr("'lake'"));
    useDataFolders("--data", {at("theirs"), at("mine")});
    EXPECT_EQ(findData("scene", "scenes", "hills", ".toml"), others);
    EXPECT_EQ(dataFolders().back(), dataFolder()) << "what is delivered is always last";
}

TEST_F(DataFolders, AFileNamedInAFileLiesBesideItElseAmongTheData) {
    const fs::path relativeToFile = add("own/meshes", "stone.ply"), both = add("mine", "shapes/meshes/stone.ply"),
                   data = add("mine", "shapes/meshes/tree.ply");
    (void)add("theirs", "shapes/meshes/tree.ply");
    const fs::path from = folder_.path() / "own" / "shape.toml";
    useDataFolders("--data", {at("mine"), at("theirs")});
    const auto named = [&](const std::string& file) { return fileNamedBy(from, "shapes", file); };
    EXPECT_EQ(named("meshes/stone.ply"), relativeToFile);
    EXPECT_EQ(named("./meshes/../meshes/stone.ply"), relativeToFile);
    EXPECT_EQ(named("meshes/tree.ply"), data);
    EXPECT_EQ(named("meshes/hare.ply"), dataFolder() / "shapes/meshes/hare.ply");
    EXPECT_EQ(named(both.string()), both);
    // The working directory has no influence.
    const fs::path before = fs::current_path();
    fs::current_path(folder_.path() / "own" / "meshes");
    EXPECT_THAT(inputError([&] { (void)named("stone.ply"); }), HasSubstr("'stone.ply': no such file"));
    fs::current_path(before);
    EXPECT_THAT(inputError([&] { (void)named("meshes/stome.ply"); }),
                AllOf(HasSubstr("'meshes/stome.ply': no such file, tried " + at("own/meshes/stome.ply") + ", " +
                                at("mine/shapes/meshes/stome.ply") + ", "),
                      HasSubstr("did you mean '" + relativeToFile.string() + "'?")));
    EXPECT_EQ(inputError([&] { (void)named("/nowhere/a.ply"); }),
              "'/nowhere/a.ply': no such file, tried /nowhere/a.ply");
}

TEST_F(DataFolders, OfTheEnvironmentAreSeparatedByColons) {
    (void)add("mine", "drives/loop.csv");
    (void)add("theirs", "drives/lap.csv");
    setenv("DUSTBENCH_DATA", (at("mine") + "::" + at("theirs") + ":").c_str(), 1);
    EXPECT_THAT(listData("drives", ".csv"), testing::IsSupersetOf({"lap", "loop", "straight"}));
    useDataFolders("--data", {at("theirs")});
    EXPECT_THAT(listData("drives", ".csv"), AllOf(Contains("lap"), Not(Contains("loop"))));
}

TEST_F(DataFolders, ThatAreMissingOrHoldNoDataAreRefused) {
    (void)add("mine", "scenes/plain.toml");
    const auto refused = [&](const std::string& folder) {
        return inputError([&] { useDataFolders("--data", {folder}); });
    };
    EXPECT_EQ(refused(at("mime")), "--data: '" + at("mime") + "': no such folder (did you mean '" + at("mine") + "'?)");
    EXPECT_THAT(refused(at("mine/scenes")), HasSubstr("contains no data, expected one or more of the folders scenes"));
    EXPECT_THAT(refused(at("mine/scenes/plain.toml")), HasSubstr("is a file"));
    (void)add("a:b", "scenes/plain.toml");
    EXPECT_THAT(refused(at("a:b")), HasSubstr("separates folders"));
    setenv("DUSTBENCH_DATA", at("mime").c_str(), 1);
    EXPECT_THAT(inputError([] { (void)listData("scenes", ".toml"); }), HasSubstr("DUSTBENCH_DATA: "));
}

TEST_F(DataFolders, AreNotLookedThroughForFiles) {
    const fs::path file = add("mine", "scenes/hills.toml");
    EXPECT_EQ(findData("scene", "scenes", file.string(), ".toml"), file);
    EXPECT_THAT(inputError([&] { (void)findData("scene", "scenes", at("mine/scenes/hill.toml"), ".toml"); }),
                AllOf(HasSubstr("no such file"), HasSubstr("hills.toml'")));
    EXPECT_THAT(inputError([] { (void)findData("scene", "scenes", "plain.toml", ".toml"); }),
                HasSubstr("no such file"));
    EXPECT_EQ(fromFile("suites/mine.toml", "hills.toml", ".toml"), "suites/hills.toml");
    EXPECT_EQ(fromFile("suites/mine.toml", "../scenes/hills.toml", ".toml"), "scenes/hills.toml");
    EXPECT_EQ(fromFile("suites/mine.toml", "/there/hills.toml", ".toml"), "/there/hills.toml");
    EXPECT_EQ(fromFile("suites/mine.toml", "hills", ".toml"), "hills");
}

TEST_F(DataFolders, DeliveredWithAProgramMoveWithIt) {
    (void)add("tree", "data/scenes/plain.toml");
    (void)add("prefix", "share/dustbench/scenes/plain.toml");
    const auto of = [&](const std::string& program) {
        return shippedFolder(folder_.path() / program, "data", "share/dustbench");
    };
    EXPECT_EQ(of("tree/build/release/dustbench"), folder_.path() / "tree/data");
    EXPECT_EQ(of("prefix/bin/dustbench"), folder_.path() / "prefix/share/dustbench");
    EXPECT_THAT(inputError([&] { (void)of("elsewhere/build/release/dustbench"); }),
                AllOf(HasSubstr(at("elsewhere/data")), HasSubstr(at("elsewhere/build/share/dustbench"))));
}

}  // namespace
}  // namespace dustbench::files
