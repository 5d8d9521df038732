#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numeric>
#include <set>

#include "bench/report/chart_file.h"
#include "bench/report/folder_fixture.h"
#include "bench/report/page.h"
#include "bench/report/picture_sets.h"
#include "bench/report/report_json.h"
#include "bench/report/report_reader.h"
#include "bench/report/run_groups.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/pictures/picture_files.h"

namespace dustbench::report {
namespace {

namespace fs = std::filesystem;

results::StoredRun run(const std::string& method, int particles, int repetition, double ms,
                       const std::string& sort = "") {
    results::StoredRun made;
    made.runId = fmt::format("{}-{}-{}-{}", method, particles, sort, repetition);
    made.parameters["particles"] = std::to_string(particles);
    if (!sort.empty()) made.parameters["sort"] = sort;
    made.cells = {{"method", method},
                  {"scene", "plain"},
                  {"repetition", std::to_string(repetition)},
                  {"frames", "30"},
                  {"frame_ms_median", fmt::format("{}", ms)}};
    return made;
}

}  // namespace

TEST(MedianInterval, HasTheProbabilityOfTheSignTest) {
    const MedianInterval six = medianInterval({4, 6, 1, 5, 2, 3});
    EXPECT_DOUBLE_EQ(six.median, 3.5);
    EXPECT_EQ(six.low, 1);
    EXPECT_EQ(six.high, 6);
    EXPECT_DOUBLE_EQ(six.probability, 1 - 2.0 / 64);

    // 9 values: 1 − 2·(1 + 9)/512 is above 95 %, 1 − 2·(1 + 9 + 36)/512 is not.
    const MedianInterval nine = medianInterval({1, 2, 3, 4, 5, 6, 7, 8, 9});
    EXPECT_EQ(nine.low, 2);
    EXPECT_EQ(nine.high, 8);
    EXPECT_DOUBLE_EQ(nine.probability, 1 - 20.0 / 512);

    EXPECT_EQ(medianInterval({7}).low, 7);
    EXPECT_EQ(medianInterval({7}).probability, 0);
    EXPECT_TRUE(std::isnan(medianInterval({}).median));
}

TEST(FrameTimes, KeepsEveryFrameInTheHistogramAndEverySpikeInTheTrace) {
    std::vector<double> frames(10000, 16.0);
    for (std::size_t frame = 0; frame < frames.size(); ++frame)
        frames[frame] += 0.0001 * static_cast<double>(frame % 7);
    frames[4321] = 250;
    const FrameTimes times = condense(frames);
    EXPECT_EQ(std::accumulate(times.bins.begin(), times.bins.end(), 0), 10000);
    EXPECT_EQ(times.bins.back(), 1);
    EXPECT_LE(times.trace.size(), maximumTracePoints);
    EXPECT_TRUE(std::ranges::any_of(times.trace,
                                    [](const auto& point) { return point == std::pair(std::size_t{4321}, 250.0); }));
    EXPECT_TRUE(std::ranges::is_sorted(times.trace));
    EXPECT_EQ(condense(std::vector<double>(5, 3.0)).bins, std::vector<int>{5});
}

TEST(Experiments, PutRepetitionsIntoOneCellAndNameWhatDiffers) {
    results::StoredRuns runs;
    for (const int particles : {1000, 100})
        for (const int repetition : {1, 2}) {
            for (const results::StoredRun& made :
                 {run("haze", particles, repetition, particles * 0.01 + repetition, "radix"),
                  run("haze", particles, repetition, particles * 0.02 + repetition, "none"),
                  run("mist", particles, repetition, 3)})
                runs.emplace(made.runId, made);
        }
    runs.begin()->second.status = results::RunStatus::failed;
    std::vector<const results::StoredRun*> all;
    for (const auto& [id, made] : runs) all.push_back(&made);
    const RunGroup group = makeGroup(all, {});

    ASSERT_EQ(group.axes.size(), 2u);
    EXPECT_EQ(group.axes[0].name, "particles");
    EXPECT_TRUE(group.axes[0].world && group.axes[0].numeric);
    EXPECT_EQ(group.axes[0].values, (std::vector<std::string>{"100", "1000"}));
    EXPECT_EQ(group.axes[1].name, "sort");
    EXPECT_FALSE(group.axes[1].world);
    ASSERT_EQ(group.cells.size(), 6u);
    std::size_t done = 0, failed = 0;
    for (const ReportCell& cell : group.cells) {
        done += cell.done.size();
        failed += cell.failed;
    }
    EXPECT_EQ(done, 11u);
    EXPECT_EQ(failed, 1u);
    const auto cell = std::ranges::find_if(group.cells, [&](const ReportCell& one) {
        return variantLabel(group, one) == "haze sort=radix" && worldLabel(group, one) == "particles=1000";
    });
    ASSERT_NE(cell, group.cells.end());
    EXPECT_DOUBLE_EQ(cell->values.at("frame_ms_median").median, 11.5);
}

TEST(Experiments, KeepDustOnTheGpuApart) {
    results::StoredRun onCpu = run("haze", 100, 1, 3), onGpu = onCpu;
    onCpu.cells.emplace("dust_on", "cpu");
    onGpu.cells.emplace("dust_on", "gpu");
    const RunGroup group = makeGroup({&onCpu, &onGpu}, {});
    ASSERT_EQ(group.axes.size(), 1u);
    EXPECT_EQ(group.axes[0].name, "dust_on");
    EXPECT_TRUE(group.axes[0].world);
    EXPECT_EQ(group.cells.size(), 2u);
}

TEST(Experiments, FindTheExponentOfACost) {
    results::StoredRuns runs;
    for (const int particles : {100, 200, 400, 800, 1600})
        for (const int repetition : {1, 2}) {
            const results::StoredRun made = run("haze", particles, repetition, 5 + 0.001 * std::pow(particles, 1.5));
            runs.emplace(made.runId, made);
        }
    std::vector<const results::StoredRun*> all;
    for (const auto& [id, made] : runs) all.push_back(&made);
    const RunGroup group = makeGroup(all, {});
    ASSERT_EQ(group.fits.size(), 1u);
    EXPECT_EQ(group.fits[0].column, "frame_ms_median");
    EXPECT_NEAR(group.fits[0].fit.exponent.value, 1.5, 0.01);
    EXPECT_NEAR(group.fits[0].fit.fixedMs.value, 5, 0.05);
}

TEST(ReportJson, LetsNoTextBecomeMarkup) {
    ReportData data;
    data.folder = "</script><script>alert(1)</script>";
    data.problems = {"<!-- \xff\xfe not UTF-8"};
    results::StoredRun made = run("haze", 100, 1, 3);
    made.runId = "<b>";
    data.runs.emplace(made.runId, made);
    const std::string json = reportJson(data);
    EXPECT_EQ(json.find('<'), std::string::npos);
    EXPECT_NE(json.find("\\u003c/script>"), std::string::npos);

    const std::string page = pageOf(data);
    EXPECT_EQ(page.find("<script>alert"), std::string::npos);
    EXPECT_NE(page.find("&lt;script>alert(1)"), std::string::npos);
}

TEST(ReportPage, ComesWithoutAnyRunAndSaysSo) {
    const Folder folder;
    const ReportData data = readReport(folder.path(), 0);
    ASSERT_EQ(data.problems.size(), 1u) << problemsOf(data);
    EXPECT_NE(data.problems[0].find("no folder 'runs'"), std::string::npos);
    EXPECT_TRUE(fs::exists(writePage(folder.path(), data)));
    EXPECT_TRUE(fs::exists(writePage(folder.path(), data))) << "a page of ours is written over";
    EXPECT_THROW((void)readReport(folder.path() / "nowhere", 0), InputError);
}

TEST(ReportPage, LeavesAPageOfSomebodyElseAlone) {
    const Folder folder;
    folder.write("index.html", "<html>my garden</html>");
    EXPECT_THROW(writePage(folder.path(), readReport(folder.path(), 0)), InputError);
}

TEST(RunGroups, TwoSuitesOfTheSameRunsAreBothShownAndTwoFormsOfASuiteOnce) {
    const Folder folder;
    const std::string suite = "title = \"Title\"\nmethods = [\"null_method\"]\n[parameters]\nparticles = [10, 20]\n";
    fs::create_directories(folder.path() / "suites");
    folder.write("suites/one.toml", suite + "[quick]\ntitle = \"Title\"\n");
    folder.write("suites/two.toml", suite);
    files::useDataFolders("--data", {folder.path().string()});
    results::StoredRuns runs;
    for (const suite::PlannedRun& planned : suite::loadSuite("one", false).cells) {
        results::StoredRun made = run("null_method", 10, 1, 3);
        made.runId = results::runId(planned.spec);
        runs.emplace(made.runId, made);
    }
    std::vector<std::string> problems, ids;
    for (const RunGroup& group : sortIntoGroups(runs, {}, problems)) ids.push_back(group.id);
    files::useDataFolders("--data", {});
    EXPECT_EQ(ids, (std::vector<std::string>{"one", "two"}));
    EXPECT_TRUE(problems.empty());
}

TEST(ReportPictures, AreBase64) {
    EXPECT_EQ(dataUrl("image/png", "hello!"), "data:image/png;base64,aGVsbG8h");
    EXPECT_EQ(dataUrl("image/png", "hell"), "data:image/png;base64,aGVsbA==");
}

/// Writes the files of one run with metrics and pictures of 24 x 16 pixels into the folder, and returns its data.
ReportData pictured(const Folder& folder) {
    ReportData data;
    results::StoredRun made = run("haze", 100, 1, 3);
    made.cells["FILE_image"] = "runs/" + made.runId + "/images/f000030.png";
    made.cells["metric_reference"] = "exact";
    const fs::path images = folder.path() / "runs" / made.runId / "images";
    fs::create_directories(images);
    const std::vector<std::uint8_t> grey(std::size_t{24} * 16 * 3, 128);
    for (const char* name : {"f000030.png", "f000030_reference.png", "f000030_difference.png"})
        EXPECT_EQ(pictures::writePng(images / name, 24, 16, 3, grey), "");
    data.runs.emplace(made.runId, made);
    data.groups.push_back(makeGroup({&data.runs.begin()->second}, {}));
    return data;
}

TEST(ReportPictures, AreInThePageOrBesideItAsTheBudgetAllows) {
    const Folder folder;
    for (const std::int64_t budget : {std::int64_t{100'000}, std::int64_t{0}}) {
        ReportData data = pictured(folder);
        collectPictures(folder.path(), budget, data);
        ASSERT_EQ(data.pictureSets.size(), 1u);
        const PictureSet& set = data.pictureSets[0];
        EXPECT_EQ(set.frame, 30);
        ASSERT_EQ(set.pictures.size(), 3u);
        EXPECT_EQ(set.pictures[0].label, "reference");
        EXPECT_EQ(set.pictures[1].label, "haze");
        EXPECT_TRUE(set.pictures[2].difference);
        EXPECT_EQ(data.linkedPictures, budget > 0 ? 0u : 3u);
        for (const ReportPicture& picture : set.pictures)
            EXPECT_TRUE(picture.source.starts_with(budget > 0 ? "data:image/" : "runs/haze-")) << picture.source;
        EXPECT_EQ(set.width, budget > 0 ? 24 : 0) << "a linked picture is not opened";
    }
}

TEST(ReportPictures, OfTheWorstMomentAreInThePageFirst) {
    const Folder folder;
    ReportData data = pictured(folder);
    const std::string made = "runs/" + data.runs.begin()->first + "/";
    for (const char* ending : {"", "_reference", "_difference"})
        for (const char* frame : {"000010", "000050"})
            fs::copy_file(folder.path() / fmt::format("{}images/f000030{}.png", made, ending),
                          folder.path() / fmt::format("{}images/f{}{}.png", made, frame, ending));
    folder.write(made + "metrics.csv", "frame,psnr_db,ssim,flip\n10,,,0.1\n30,,,0.4\n50,,,0.2\n");
    collectPictures(folder.path(), 100'000, data);
    const std::string& whole = data.pictureSets.at(0).pictures.at(0).source;
    const auto room = static_cast<std::int64_t>(3 * (whole.size() - whole.find(',')));  // one of three
    data.pictureSets.clear();
    data.linkedPictures = 0;
    collectPictures(folder.path(), room, data);
    EXPECT_EQ(data.linkedPictures, 6u);
    for (const PictureSet& set : data.pictureSets)
        for (const ReportPicture& picture : set.pictures)
            EXPECT_EQ(picture.source.starts_with("data:"), set.frame == 30) << set.frame << " " << picture.label;
}

TEST(ReportPictures, CarryTheMetricsOfTheirFrame) {
    const Folder folder;
    ReportData data = pictured(folder);
    folder.write("runs/" + data.runs.begin()->first + "/metrics.csv",
                 "frame,psnr_db,ssim,flip\n15,20,0.5,0.4\n30,41.5,0.99,\n31,,,\n");
    collectPictures(folder.path(), 100'000, data);
    const auto& pictures = data.pictureSets.at(0).pictures;
    EXPECT_TRUE(pictures.at(0).numbers.empty()) << "the exact picture has no error";
    EXPECT_EQ(pictures.at(1).numbers, (PictureNumbers{{"psnr_db", 41.5}, {"ssim", 0.99}}));
    EXPECT_EQ(pictures.at(2).numbers, pictures.at(1).numbers);

    folder.write("runs/" + data.runs.begin()->first + "/metrics.csv", "frame,psnr_db\n30,much\n");
    data.pictureSets.clear();
    collectPictures(folder.path(), 100'000, data);
    EXPECT_TRUE(data.pictureSets.at(0).pictures.at(1).numbers.empty());
}

TEST(ReportPictures, AreMissedAndNamedWhereTheyAreDamaged) {
    const Folder folder;
    ReportData data = pictured(folder);
    folder.write("runs/" + data.runs.begin()->first + "/images/f000030_reference.png", "no picture");
    collectPictures(folder.path(), 100'000, data);
    ASSERT_EQ(data.problems.size(), 1u);
    EXPECT_NE(data.problems[0].find("f000030_reference.png"), std::string::npos);
    EXPECT_EQ(data.pictureSets.at(0).pictures.size(), 2u);

    fs::remove_all(folder.path() / "runs");
    ReportData gone = pictured(folder);
    fs::remove_all(folder.path() / "runs");
    collectPictures(folder.path(), 100'000, gone);
    EXPECT_NE(problemsOf(gone).find("the pictures of 1 run are missing"), std::string::npos);
}

TEST(Report, ChartsOfASettingNeedMoreThanItsSeeds) {
    results::StoredRuns runs;
    for (const int seed : {1, 2, 3, 4, 5})
        for (const char* sort : {"none", "radix"}) {
            results::StoredRun made = run("haze", 100, 1, 3 + seed, sort);
            made.cells["seed"] = std::to_string(seed);
            made.runId += fmt::format("-{}", seed);
            runs.emplace(made.runId, made);
        }
    std::vector<const results::StoredRun*> all, alone;
    for (const auto& [id, made] : runs) {
        all.push_back(&made);
        if (made.parameters.at("sort") == "none") alone.push_back(&made);
    }
    ReportData data;
    data.groups.push_back(makeGroup(alone, {}));
    EXPECT_TRUE(data.groups[0].fits.empty()) << "nothing grows with a seed";
    EXPECT_EQ(data.groups[0].common.at("particles"), "100");
    EXPECT_FALSE(data.groups[0].common.contains("seed"));
    data.groups[0].id = "one";
    data.groups.push_back(makeGroup(all, {}));
    data.groups[1].id = "two";
    EXPECT_EQ(chartIds(data), (std::vector<std::string>{"one-stages", "two", "two-stages"}));
}

TEST(Report, AMapNeedsAClaimAlongANumberAndASecondSetting) {
    const auto claim = [](const std::string& along, const std::vector<claims::Selection>& cells) {
        claims::EvaluatedClaim made;
        made.paper = "mud";
        made.claim.rule.along = along;
        for (const claims::Selection& cell : cells) made.result.cells.emplace_back().cell = cell;
        return made;
    };
    const auto cell = [](const char* edge, const char* speed) {
        return claims::Selection{{"p.voxel_edge", edge}, {"p.speed", speed}};
    };
    const auto idsOf = [](const claims::EvaluatedClaim& evaluated) {
        ReportData data;
        data.papers.emplace_back().id = "mud";
        data.claims = {evaluated, evaluated};
        return chartIds(data);
    };
    EXPECT_EQ(idsOf(claim("p.voxel_edge", {cell("1", "5"), cell("1", "10"), cell("2", "5")})),
              std::vector<std::string>{"mud-by-voxel_edge"});
    EXPECT_TRUE(idsOf(claim("p.voxel_edge", {cell("1", "5"), cell("2", "5")})).empty()) << "one speed";
    EXPECT_TRUE(idsOf(claim("p.depth", {cell("1", "5"), cell("1", "10")})).empty()) << "no depth";
    EXPECT_TRUE(idsOf(claim("", {cell("1", "5"), cell("1", "10")})).empty());
}

TEST(PapersPage, ListsEachPaperWithItsVerdicts) {
    ReportData data;
    results::StoredRun warned = run("haze", 100, 1, 3), failed = run("haze", 200, 1, 3);
    data.runs.emplace(warned.runId, warned);
    data.runs.emplace(failed.runId, failed);
    data.notDone.push_back({failed.runId, "failed", "it rained"});
    data.warnings = {{"busy", {warned.runId}}, {"slow", {warned.runId, failed.runId}}};
    data.machines = {{{"cpu", "A<B>"}, {"cores", "2"}, {"gl_renderer", "llvmpipe"}}};
    RunGroup group;
    group.suite = "dust";
    group.id = "dust-quick";
    data.groups.push_back(group);
    suite::Paper paper, other;
    paper.id = "mud";
    paper.title = "Mud & dust";
    paper.authors = "Nobody";
    paper.year = 2026;
    other.id = "air";
    for (const auto& [of, verdict] :
         {std::pair(&paper, claims::ClaimVerdict::confirmed), std::pair(&paper, claims::ClaimVerdict::notTested),
          std::pair(&paper, claims::ClaimVerdict::confirmed), std::pair(&other, claims::ClaimVerdict::refuted)}) {
        claims::EvaluatedClaim claim;
        claim.paper = of->id;
        claim.result.verdict = verdict;
        data.claims.push_back(claim);
    }
    const PaperLine line = lineOf(data, paper, "mud");
    EXPECT_EQ(line.runs, 2u);
    EXPECT_EQ(line.runsDone, 1u);
    EXPECT_EQ(line.runsWithWarnings, 2u);
    EXPECT_EQ(line.form, "quick");
    EXPECT_EQ(line.verdicts, (std::array<std::size_t, 6>{2, 0, 0, 0, 0, 1}));

    const std::string page = papersPage({line});
    for (const char* part : {"href=\"mud/index.html\"", "Nobody (2026): Mud &amp; dust", "2 confirmed", "1 not-tested",
                             "1 of 2", "A&lt;B>, 2 cores, llvmpipe"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_EQ(page.find("refuted\">"), std::string::npos) << "of another paper";
    EXPECT_EQ(page.find("{{"), std::string::npos);

    const Folder folder;
    EXPECT_TRUE(fs::exists(writePapersPage(folder.path(), {line})));
    EXPECT_NO_THROW(writePapersPage(folder.path(), {line}));
    folder.write("index.html", "<html>my garden</html>");
    EXPECT_THROW(writePapersPage(folder.path(), {line}), InputError);
}

TEST(Report, APaperWhoseRunsAreAnothersControlsIsNotJudged) {
    const auto group = [](const char* paper, const char* suite) {
        RunGroup made;
        made.paper = paper;
        made.suite = suite;
        return made;
    };
    const RunGroup own = group("juckel2007", "voxelshape-grid"), lent = group("senger2009", "senger-particles"),
                   other = group("senger2009", "senger-memory"), exchanged = group("juckel2007", "voxelshape-memory");
    EXPECT_EQ(papersOf({own, lent, group("", "mine")}), (std::set<std::string>{"juckel2007"}));
    EXPECT_EQ(papersOf({own, lent, other}), (std::set<std::string>{"juckel2007", "senger2009"}));
    EXPECT_EQ(papersOf({lent}), (std::set<std::string>{"senger2009"}));
    EXPECT_EQ(papersOf({lent, exchanged}), (std::set<std::string>{"juckel2007", "senger2009"}));
}

}  // namespace dustbench::report
