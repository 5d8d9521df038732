// Options of `run`: --camera-path, --at, --dust, and --video and --gif with a stand-in for ffmpeg.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/cli/called_program.h"
#include "bench/results/stored_run.h"
#include "methods/kit/files/csv.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_F(Dustbench, ARunFollowsACameraPath) {
    std::ofstream(folder_ / "path.csv") << "time_s,eye_x,eye_y,eye_z,target_x,target_y,target_z,fov_deg\n"
                                           "0,0,6,20,0,1,0,50\n1,10,6,20,10,1,0,50\n";
    const std::string path = (folder_ / "path.csv").string();
    const auto pictureOf = [&](const std::string& name, const std::string& more) {
        const std::string folder = (folder_ / name).string();
        const Called called = shortRun("--frames 3 --images 2 --out " + folder + more);
        EXPECT_EQ(called.code, 0) << called.err;
        return contentOf(runs(folder).at(0) / "images" / "f000002.png");
    };
    const std::string chase = pictureOf("chase", "");
    const std::string followed = pictureOf("path", " --camera-path " + path);
    EXPECT_NE(followed, chase);
    EXPECT_EQ(followed, pictureOf("rows", " --camera-path '0,0,6,20,0,1,0,50;1,10,6,20,10,1,0,50'"));
    const std::string record = contentOf(runs((folder_ / "path").string()).at(0) / "run.json");
    EXPECT_THAT(record, HasSubstr("\"camera_path\": \"" + path + "\""));
    EXPECT_THAT(record, HasSubstr("{\n        \"file\": \"" + path));
    EXPECT_EQ(shortRun("--frames 1 --camera-path nowhere.csv --out " + out()).code, 3);
    EXPECT_FALSE(fs::exists(out()));
}

// --- --at: changes during a run are part of its identity

class Changes : public Dustbench {
 protected:
    void SetUp() override {
        Dustbench::SetUp();
        if (std::ranges::find(dustbench::methods(), "plugin_particles", &MethodInfo::id) == dustbench::methods().end())
            GTEST_SKIP() << "no method plugin_particles";
    }
    /// The run that these arguments make.
    results::StoredRun run(const std::string& arguments) {
        const std::string out = (folder_ / std::to_string(++count_)).string();
        const Called called =
            call("run --method plugin_particles --frames 12 --warmup 2 --size 32x24 -P preroll=0.2 -P particles=300 " +
                 arguments + " --out " + out);
        EXPECT_EQ(called.code, 0) << called.err;
        kept_ = contentOf(runs(out).at(0) / "systems.toml");
        return results::readRunFile(runs(out).at(0) / "run.json");
    }

    int count_ = 0;
    std::string kept_;
};

TEST_F(Changes, BelongToTheRunAndAreKept) {
    const auto plain = run(""), one = run("--at 0.1s:velocity.speed=8"), again = run("--at 0.10s:velocity.speed=8");
    EXPECT_EQ(one.runId, again.runId);
    EXPECT_EQ(one.methodHash, again.methodHash);
    EXPECT_EQ(one.parameters.at("at"), "0.1s:velocity.speed=8");
    EXPECT_NE(one.runId, plain.runId);
    EXPECT_EQ(plain.methodHash, plain.stateHash);
    EXPECT_NE(one.methodHash, plain.methodHash);
    EXPECT_EQ(one.stateHash, plain.stateHash) << "the shared dust is altered";
    const auto two = run("--at 0.1s:velocity.speed=8 --at 0.05s:size.part=constant");
    EXPECT_EQ(two.parameters.at("at"), "0.05s:size.part=constant;0.1s:velocity.speed=8");
    EXPECT_NE(two.methodHash, one.methodHash);
    EXPECT_THAT(kept_, testing::AllOf(HasSubstr("speed = 8\n"), HasSubstr("[size]\npart = \"constant\"")));
}

TEST_F(Changes, AreRefusedInOneLineWhereTheyCannotBe) {
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"plugin_particles --at -1s:velocity.speed=8", "at 0 s (the first recorded frame) or later"},
        {"plugin_particles --at 1:velocity.speed=8", "SECONDSs:NAME=VALUE"},
        {"plugin_particles --at 1s:velocty.speed=8", "'velocity'"},
        {"plugin_particles --at 1s:velocity.sped=8", "'speed'"},
        {"plugin_particles --at 1s:velocity.part=con", "'cone'"},
        {"plugin_particles --at 1s:velocity.speed=fast", "number 0..1000"},
        {"plugin_particles --frames 60 --at 1s:velocity.speed=8", "after the last frame"},
        {"plugin_particles -P system=wheel_dst", "'wheel_dust'"},
        {"null_method --at 1s:velocity.speed=8", "null_method"},
    };
    for (const auto& [arguments, expected] : mistakes) {
        const fs::path out = folder_ / "refused";
        const Called called = call("run -P preroll=0 --size 32x24 --method " + arguments + " --out " + out.string());
        EXPECT_EQ(called.code, 3) << arguments;
        // A progress line may precede it if only the run's process detects the mistake.
        const std::size_t at = called.err.find("dustbench: ");
        ASSERT_NE(at, std::string::npos) << called.err;
        EXPECT_EQ(std::ranges::count(called.err.substr(at), '\n'), 1) << called.err;
        EXPECT_THAT(called.err, HasSubstr(expected)) << arguments;
        EXPECT_TRUE(!fs::exists(out / "runs") || runs(out.string()).empty()) << arguments;
    }
}

// --- --dust: particles from files, including those of our own export

class DustOption : public Dustbench {
 protected:
    /// The world of the round trip; `particles` only where it emits its own dust.
    static constexpr const char* world = " --size 96x72 --warmup 2 -P preroll=0.2 --threads 2 ";

    [[nodiscard]] std::string exported() const {
        const std::string to = (folder_ / "exported").string();
        const Called called = call(std::string("export --method null_method -P particles=300 --frames 0:31:1 ") +
                                   world + "--format vtp --out " + to);
        EXPECT_EQ(called.code, 0) << called.err;
        return to + "/particles.pvd";
    }
    [[nodiscard]] fs::path run(const std::string& name, const std::string& more) const {
        const std::string to = (folder_ / name).string();
        const Called called =
            call("run --frames 31 --images 30 --metrics " + std::string(world) + more + " --out " + to);
        EXPECT_EQ(called.code, 0) << called.err;
        const auto all = runs(to);
        return all.empty() ? fs::path() : all.front();
    }
    [[nodiscard]] static std::string stateHash(const fs::path& run) {
        const std::string record = contentOf(run / "run.json");
        const std::size_t at = record.find("\"state_hash\"");
        return record.substr(at, record.find('\n', at) - at);
    }
    /// A cloud in the camera's view, one row per particle, for `times` moments.
    [[nodiscard]] std::string table(int times) const {
        const fs::path file = folder_ / "cloud.csv";
        std::ofstream csv(file);
        csv << "time,id,x,y,z,radius,opacity\n";
        for (int t = 0; t < times; ++t)
            for (int i = 0; i < 5; ++i) csv << 0.1 * t << ',' << i << ',' << i + t << ",1," << i << ",0.5,0.3\n";
        return file.string();
    }
};

TEST_F(DustOption, ReadsOurOwnExportBackWithTheSameStatePicturesAndMetrics) {
    const std::string dust = exported();
    for (const char* method : {"billboard", "octree_search"}) {
        const std::string id = std::string("--method ") + method;
        const fs::path own = run(std::string(method) + "-own", id + " -P particles=300");
        const fs::path given = run(std::string(method) + "-given", id + " --dust " + dust);
        EXPECT_EQ(stateHash(own), stateHash(given));
        for (const char* picture : {"f000000.png", "f000030.png", "f000030.exr", "f000030_reference.exr"})
            EXPECT_TRUE(contentOf(own / "images" / picture) == contentOf(given / "images" / picture)) << picture;
        const auto expected = files::CsvTable::parseFile(own / "metrics.csv"),
                   got = files::CsvTable::parseFile(given / "metrics.csv");
        ASSERT_EQ(expected.rows(), got.rows());
        EXPECT_GE(expected.rows(), 31u);
        for (const char* column : {"psnr_db", "ssim", "flip", "rmse_linear", "popping", "cutoff", "volume_error"})
            for (std::size_t row = 0; row < expected.rows(); ++row)
                EXPECT_EQ(expected.cell(row, column), got.cell(row, column)) << column << " of row " << row;
    }
}

TEST_F(DustOption, TheFilesAreInputsAndTheNameIsOfTheKey) {
    const std::string dust = table(20);
    const std::string record = contentOf(run("out", "--method billboard --dust " + dust) / "run.json");
    EXPECT_THAT(record, HasSubstr("\"dust\": \"" + dust + "\""));
    EXPECT_THAT(record, HasSubstr("\"file\": \"" + dust + "\""));
    EXPECT_THAT(record, HasSubstr("dust=" + dust));
    // A change of the file makes the result outdated.
    std::ofstream(dust, std::ios::app) << "9,1,1,1,1,1,0.5\n";
    const Called again = call("run --frames 31 --images 30 --metrics " + std::string(world) +
                              "--method billboard --dust " + dust + " --out " + (folder_ / "out").string());
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_NE(contentOf(runs((folder_ / "out").string()).front() / "run.json"), record);
}

TEST_F(DustOption, WhatEndsBeforeTheRunIsRefusedBeforeItBegins) {
    const Called called = call("run --method billboard --frames 31 --dust " + table(3) + " --out " + out());
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("ends 0.2 s after its first moment, the run's last frame is at 0.5 s, allowed: "
                                      "--frames 1..13"));
    EXPECT_FALSE(fs::exists(out()));
    const Called both = call("run --method billboard --frames 2 -P particles=7 --dust " + table(3) + " --out " + out());
    EXPECT_EQ(both.code, 3);
    EXPECT_THAT(both.err, HasSubstr("parameter particles: got 7 with --dust"));
    const Called alone = call("run --method billboard --frames 2 --dust-columns id=a --out " + out());
    EXPECT_EQ(alone.code, 3);
    EXPECT_THAT(alone.err, HasSubstr("--dust-columns: requires --dust"));
}

TEST_F(DustOption, ASuiteNamesItRelativeToItself) {
    (void)table(3);
    std::ofstream(folder_ / "mine.toml") << "methods = [\"billboard\", \"octree_search\"]\nframes = 3\nsizes = "
                                            "[\"64x48\"]\nmetrics = true\ndust = \"cloud.csv\"\ndust_columns = "
                                            "\"radius=0.7\"\n";
    const Called called = call("suite " + (folder_ / "mine.toml").string() + " --out " + out());
    EXPECT_EQ(called.code, 0) << called.err;
    EXPECT_EQ(runs(out()).size(), 2u);
    EXPECT_THAT(contentOf(runs(out()).front() / "run.json"), HasSubstr("dust_columns=radius=0.7\\n"));
}

TEST_F(DustOption, ComparesMethodsOnIt) {
    const Called called = call("compare billboard octree_search --repetitions 1 --frames 6 --size 64x48 --dust " +
                               table(3) + " --out " + out());
    EXPECT_EQ(called.code, 0) << called.err;
    EXPECT_TRUE(fs::exists(fs::path(out()) / "contact_sheet.png"));
    EXPECT_EQ(runs(out()).size(), 3u);
}

// --- --video and --gif

class Film : public Dustbench {
 protected:
    void SetUp() override {
        Dustbench::SetUp();
        const char* const path = std::getenv("PATH");
        path_ = path ? path : "";
    }
    void TearDown() override {
        setenv("PATH", path_.c_str(), 1);
        Dustbench::TearDown();
    }
    /// An ffmpeg that records its arguments and the pictures that it finds.
    void install(const std::string& last) const {
        const fs::path bin = folder_ / "bin";
        fs::create_directories(bin);
        std::ofstream(bin / "ffmpeg") << "#!/bin/sh\necho \"$@\" >> '" << (folder_ / "arguments").string()
                                      << "'\nfor last; do :; done\n"
                                      << last << "\n";
        fs::permissions(bin / "ffmpeg", fs::perms::owner_all);
        setenv("PATH", (bin.string() + ":" + path_).c_str(), 1);
    }
    [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }

    std::string path_;
};

TEST_F(Film, IsMadeOfEveryPictureAfterTheRun) {
    install("echo film > \"$last\"");
    const Called called =
        shortRun("--frames 4 --video " + file("films/a.mp4") + " --gif " + file("a.gif") + " --out " + out());
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_EQ(contentOf(folder_ / "films" / "a.mp4"), "film\n");
    EXPECT_EQ(contentOf(folder_ / "a.gif"), "film\n");
    const std::string arguments = contentOf(folder_ / "arguments");
    EXPECT_THAT(arguments, HasSubstr("-framerate 60/1 -pattern_type glob -i " +
                                     (runs(out()).at(0) / "images/f??????.png").string()));
    EXPECT_THAT(arguments, HasSubstr("palettegen"));
    for (int frame = 0; frame < 4; ++frame)
        EXPECT_TRUE(fs::exists(runs(out()).at(0) / "images" / fmt::format("f{:06}.png", frame)));
    for (const auto& entry : fs::directory_iterator(folder_ / "films")) EXPECT_EQ(entry.path().filename(), "a.mp4");
}

TEST_F(Film, OfEverySecondPictureHasHalfTheRate) {
    install("echo film > \"$last\"");
    const Called called = shortRun("--frames 4 --images 2 --gif " + file("a.gif") + " --out " + out());
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(contentOf(folder_ / "arguments"), HasSubstr("-framerate 60/2 "));
}

TEST_F(Film, ThatFailsIsOneLineAndLeavesNothing) {
    install("echo half > \"$last\"; echo 'unknown encoder' >&2; exit 1");
    const Called called = shortRun("--frames 2 --video " + file("a.mp4") + " --out " + out());
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("--video: ffmpeg: exit code 1: unknown encoder"));
    EXPECT_FALSE(fs::exists(folder_ / "a.mp4"));
    for (const auto& entry : fs::directory_iterator(folder_))
        EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("part")));
    EXPECT_EQ(runs(out()).size(), 1u);  // the run is kept
}

TEST_F(Film, IsRefusedBeforeTheRun) {
    install("");
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"--video x.avi", "--video: got 'x.avi', allowed: a .mp4"},
        {"--gif x.mp4", "--gif: got 'x.mp4', allowed: a .gif file"},
        {"--gif x.gif -P particles=100,200", "--gif: got 2 runs, allowed: 1"}};
    for (const auto& [options, expected] : mistakes) {
        const std::string command =
            "run --method " + methods().front().id + " --frames 2 " + options + " --out " + out();
        const Called called = call(command);
        EXPECT_EQ(called.code, 3) << called.err;
        EXPECT_THAT(called.err, HasSubstr(expected));
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
    }
    setenv("PATH", folder_.c_str(), 1);
    const Called called = shortRun("--frames 2 --video a.mp4 --out " + out());
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("--video: the program ffmpeg is not on the PATH"));
    EXPECT_FALSE(fs::exists(out()));
}

}  // namespace
}  // namespace dustbench::cli
