// `--dust`: particles from files, including those of our own export.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/cli/called_program.h"
#include "methods/kit/files/csv.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;

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

}  // namespace
}  // namespace dustbench::cli
