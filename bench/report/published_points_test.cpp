#include "bench/report/published_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include "bench/report/folder_fixture.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::report {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// A paper with a chart against a load, a chart of bars, a chart of bytes without times, and a suite with one
/// configuration.
class Published : public testing::Test {
 protected:
    void SetUp() override {
        if (const char* before = std::getenv("DUSTBENCH_DATA")) old_ = before;
        write("paper.toml",
              "id = \"mud\"\ntitle = \"\"\nauthors = \"\"\nyear = 2006\nvenue = \"\"\nkey = \"Carr2006\"\nsummary = "
              "\"\"\n"
              "suites = [\"mud-loads\", \"mud-bars\", \"mud-bytes\", \"mud-single\"]\n");
        suite("mud-loads", "chart = \"frame_ms_median against particles\"\nmethods = [\"billboard\"]\n",
              "particles = [100, 400]\n[method.billboard]\nsort = [\"none\", \"radix\"]\n");
        suite("mud-bars", "methods = [\"billboard\", \"octree_search\"]\n", "particles = 100\n");
        suite("mud-bytes", "chart = \"cpu_bytes against particles\"\ntimes = false\nmethods = [\"billboard\"]\n",
              "particles = [100, 400]\n");
        suite("mud-single", "methods = [\"billboard\"]\n", "particles = 100\n");
        setenv("DUSTBENCH_DATA", folder_.path().c_str(), 1);
    }
    void TearDown() override { old_ ? setenv("DUSTBENCH_DATA", old_->c_str(), 1) : unsetenv("DUSTBENCH_DATA"); }

    void write(const std::string& name, const std::string& text) const { folder_.write("papers/mud/" + name, text); }
    void suite(const std::string& id, const std::string& head, const std::string& parameters) const {
        write("suites/" + id + ".toml",
              "title = \"\"\nsummary = \"\"\nframes = 2\n" + head + "[parameters]\npreroll = 1\n" + parameters);
    }
    void rows(const std::string& text) const {
        write("published.csv", "suite,of,axis,x,column,unit,min,max,hardware,what\n" + text);
    }
    /// The error message for a file whose second row is this one.
    [[nodiscard]] std::string faultOf(const std::string& row) const {
        rows("mud-loads,billboard sort=none,particles,100,fps_avg,frames/s,40,40,a PC of 2006,puffs\n" + row + "\n");
        try {
            (void)readPublished("mud");
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    Folder folder_;
    std::optional<std::string> old_;
};

TEST_F(Published, PointsAndBandsAreRead) {
    EXPECT_TRUE(readPublished("mud").empty());
    rows(
        "mud-loads,billboard sort=none,particles,200,fps_avg,frames/s,40,42,a PC (2006),puffs\n"
        "mud-loads,billboard sort=radix,particles,200,frame_ms_median,ms,40,40,a PC (2006),sorted puffs\n"
        "mud-bars,billboard,,,fps_avg,frames/s,10,15,a PC (2006),no load\n"
        "mud-bytes,billboard,particles,400,cpu_bytes,bytes,1e6,1e6,a PC (2006),memory\n");
    const auto points = readPublished("mud");
    ASSERT_EQ(points.size(), 3u);
    ASSERT_EQ(points.at("mud-loads").size(), 2u);
    const PublishedPoint& first = points.at("mud-loads").front();
    EXPECT_EQ(first.x, 200);
    EXPECT_EQ(first.minimum, 40);
    EXPECT_EQ(first.maximum, 42);
    EXPECT_EQ(first.hardware, "a PC (2006)");
    EXPECT_EQ(claims::textOf(first.of), "billboard sort=none");
    EXPECT_TRUE(points.at("mud-bars").front().axis.empty());
}

TEST_F(Published, ARowWithoutAPlaceIsAnErrorThatNamesIt) {
    const std::string end = ",a PC of 2006,it";
    const struct {
        std::string row;
        std::vector<std::string> said;
    } faults[] = {
        {"mud-lods,billboard sort=none,particles,200,fps_avg,frames/s,4,4" + end,
         {"suite: got 'mud-lods'", "mud-loads"}},
        {"mud-single,billboard,,,fps_avg,frames/s,4,4" + end, {"suite: got 'mud-single'", "two configurations"}},
        {"mud-loads,billboard sort=none,p.particles,200,fps_avg,frames/s,4,4" + end,
         {"axis: got 'p.particles'", "allowed: particles"}},
        {"mud-loads,billboard,sort,1,fps_avg,frames/s,4,4" + end, {"axis: got 'sort'", "allowed: particles"}},
        {"mud-bars,billboard,particles,100,fps_avg,frames/s,4,4" + end, {"axis: got 'particles'", "no load"}},
        {"mud-loads,billboard sort=none,particles,500,fps_avg,frames/s,4,4" + end, {"x: got '500'", "100 to 400"}},
        {"mud-loads,billboard sort=none,particles,200,fps_avg,ms,4,4" + end, {"unit: got 'ms'", "allowed: frames/s"}},
        {"mud-loads,billboard sort=none,particles,200,frame_ms_median,frames/s,4,4" + end,
         {"unit: got 'frames/s'", "allowed: ms"}},
        {"mud-loads,billboard sort=none,particles,200,build_ms_median,ms,4,4" + end,
         {"column: got 'build_ms_median'", "frame_ms_median"}},
        {"mud-bytes,billboard,particles,200,fps_avg,frames/s,4,4" + end, {"column: got 'fps_avg'", "cpu_bytes"}},
        {"mud-loads,octree_search,particles,200,fps_avg,frames/s,4,4" + end,
         {"of: got 'octree_search'", "billboard sort=none"}},
        {"mud-loads,billboard sort=quicksort,particles,200,fps_avg,frames/s,4,4" + end,
         {"of: got 'billboard sort=quicksort'", "billboard sort=radix"}},
        {"mud-loads,billboard,particles,200,fps_avg,frames/s,4,4" + end, {"of: got 'billboard (2 series)'", "one of"}},
        {"mud-loads,billboard sort=none,particles,100,fps_avg,frames/s,28,28" + end,
         {"without another number at this place"}},
        {"mud-loads,billboard sort=none,particles,200,fps_avg,frames/s,5,4" + end, {"max: got '4'", "5 and above"}},
        {"mud-loads,billboard sort=none,particles,200,fps_avg,frames/s,4,4,a PC,it", {"hardware: got 'a PC'", "year"}},
    };
    EXPECT_EQ(faultOf("mud-loads,billboard sort=radix,particles,200,fps_avg,frames/s,4,4" + end), "");
    for (const auto& [row, said] : faults) {
        const std::string fault = faultOf(row);
        EXPECT_THAT(fault, AllOf(HasSubstr("published.csv:3: "), HasSubstr("allowed: "))) << row;
        for (const std::string& part : said) EXPECT_THAT(fault, HasSubstr(part)) << row;
        EXPECT_EQ(fault.find('\n'), std::string::npos) << row;
    }
}

TEST_F(Published, APointOfAnotherSeriesContradictsThePrintedNumbers) {
    write("numbers.csv",
          "what,suite,of,columns,published,formula\nit,mud-loads,billboard sort=radix particles=400,fps_avg,28,\n"
          "it,mud-loads,billboard sort=radix particles=200,fps_avg,++: too fast,\n");
    const std::string at = ",particles,400,fps_avg,frames/s,";
    EXPECT_EQ(faultOf("mud-loads,billboard sort=radix" + at + "28,28,a PC of 2006,it"), "");
    EXPECT_EQ(faultOf("mud-loads,billboard sort=none" + at + "66,66,a PC of 2006,it"), "");
    EXPECT_THAT(faultOf("mud-loads,billboard sort=radix" + at + "66,66,a PC of 2006,it"),
                AllOf(HasSubstr("min: got '66'"), HasSubstr("28"), HasSubstr("numbers.csv")));
    EXPECT_THAT(faultOf("mud-loads,billboard sort=radix,particles,200,fps_avg,frames/s,66,66,a PC of 2006,it"),
                AllOf(HasSubstr("min: got '66'"), HasSubstr("++: too fast"), HasSubstr("numbers.csv")));
}

TEST_F(Published, AGroupShowsThoseOfItsSeries) {
    rows(
        "mud-loads,billboard sort=none,particles,200,fps_avg,frames/s,40,42,a PC (2006),puffs\n"
        "mud-loads,billboard sort=radix,particles,200,fps_avg,frames/s,4,4,a PC (2006),sorted puffs\n");
    results::StoredRun run;
    run.parameters = {{"particles", "100"}, {"sort", "none"}};
    run.cells = {{"method", "billboard"}};
    RunGroup group;
    group.cells.resize(1);
    group.cells[0].method = "billboard";
    group.cells[0].done = {&run};
    const auto points = readPublished("mud").at("mud-loads");
    const auto alone = publishedIn(group, points);
    ASSERT_EQ(alone.size(), 1u);
    EXPECT_EQ(alone[0].maximum, 42);
    EXPECT_TRUE(alone[0].settings.empty()) << "one sorting alone is not an axis";
    group.cells[0].settings = {{"sort", "none"}, {"particles", "100"}};
    EXPECT_EQ(publishedIn(group, points).at(0).settings.at("sort"), "none");
    EXPECT_EQ(publishedIn(group, points).at(0).method, "billboard");
}

TEST(PublishedNumbers, OfEveryPaperHaveTheirPlaces) {
    std::size_t numbers = 0;
    for (const std::string& paper : suite::listPapers())
        for (const auto& [suite, points] : readPublished(paper)) numbers += points.size();
    EXPECT_GE(numbers, 13u);
}

/// The thesis's file with one text replaced by another.
TEST(PublishedNumbers, OfTheThesisAreHeldToItsSuites) {
    const Folder folder;
    const fs::path thesis = files::dataFolder() / "papers" / "plugin-thesis";
    fs::create_directories(folder.path() / "papers");
    fs::copy(thesis, folder.path() / "papers" / "plugin-thesis", fs::copy_options::recursive);
    const std::string whole = files::wholeText(thesis / "published.csv", "it");
    const char* before = std::getenv("DUSTBENCH_DATA");
    const std::string old = before ? before : "";
    setenv("DUSTBENCH_DATA", folder.path().c_str(), 1);
    EXPECT_NO_THROW((void)readPublished("plugin-thesis"));
    for (const auto& [from, to] : {std::pair{",particles,", ",p.particles,"},
                                   {"frames/s", "ms"},
                                   {"system=thesis_points,particles,500,fps_avg,frames/s,82,82",
                                    "system=thesis_sprites,particles,500,fps_avg,frames/s,82,82"},
                                   {"frames/s,66,66", "frames/s,82,82"},
                                   {"thesis-table", "thesis-tables"}}) {
        std::string planted = whole;
        ASSERT_NE(planted.find(from), std::string::npos) << from;
        planted.replace(planted.find(from), std::string(from).size(), to);
        std::ofstream(folder.path() / "papers" / "plugin-thesis" / "published.csv") << planted;
        EXPECT_THROW((void)readPublished("plugin-thesis"), InputError) << from << " → " << to;
    }
    before ? setenv("DUSTBENCH_DATA", old.c_str(), 1) : unsetenv("DUSTBENCH_DATA");
}

}  // namespace
}  // namespace dustbench::report
