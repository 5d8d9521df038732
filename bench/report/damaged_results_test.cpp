#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "bench/measure/sha256.h"
#include "bench/report/folder_fixture.h"
#include "bench/report/page.h"
#include "bench/report/report_reader.h"

namespace dustbench::report {
namespace {

namespace fs = std::filesystem;

/// The run.json of a completed run, with these fields of its summary and this warning.
std::string runJson(const std::string& id, const std::string& cells, const std::string& warning = "slow") {
    return fmt::format(
        R"({{"run_id": "{}", "status": "done", "reason": "", "parameters": {{}}, "summary": {{"method": "haze", {}}},
        "warnings": ["{}"], "state_hash": "", "method_hash": null, "provenance": {{"cpu": "one", "inputs": []}}}})",
        id, cells, warning);
}

}  // namespace

TEST(ReportPage, NamesWhatIsDamagedAndGoesOn) {
    const Folder folder;
    folder.write("runs/broken/run.json", "{\"run_id\": ");
    folder.write("runs/other/run.json",
                 R"({"run_id": "mine", "status": "failed", "reason": "it rained", "parameters": {},
        "summary": {"method": "haze", "moon_phase": 3}, "warnings": [], "state_hash": "", "method_hash": null,
        "provenance": {"cpu": "one", "inputs": []}})");
    fs::rename(folder.path() / "runs/other", folder.path() / "runs/mine");
    folder.write("runs/stray/run.json", "[]");
    const ReportData data = readReport(folder.path(), 0);
    EXPECT_EQ(data.runs.size(), 1u);
    const std::string said = problemsOf(data);
    for (const char* part : {"broken", "stray", "1 of 1 runs are not done", "moon_phase"})
        EXPECT_NE(said.find(part), std::string::npos) << part << " in\n" << said;
    ASSERT_EQ(data.notDone.size(), 1u);
    EXPECT_EQ(data.notDone[0].reason, "it rained");
}

TEST(ReportPage, LeavesOutRunsWhoseFilesWereAlteredAndSaysWhichCannotTell) {
    const Folder folder;
    const auto write = [&](const std::string& id, const std::string& frames, const std::string& outputs) {
        std::string text = runJson(id, "\"frame_ms_median\": 2, \"repetition\": 1");
        text.insert(text.rfind('}'), outputs);
        folder.write("runs/" + id + "/run.json", text);
        folder.write("runs/" + id + "/frames.csv", frames);
    };
    const std::string frames = "frame,frame_ms\n0,1.5\n1,2.5\n";
    const std::string sum = fmt::format(R"(, "outputs": [{{"file": "frames.csv", "bytes": {}, "sha256": "{}"}}])",
                                        frames.size(), measure::sha256(frames));
    write("whole", frames, sum);
    write("faster", "frame,frame_ms\n0,0.5\n1,0.5\n", sum);
    write("shorter", "frame,frame_ms\n0,1.5\n", sum);
    write("older", frames, "");
    const ReportData data = readReport(folder.path(), 0);
    EXPECT_EQ(data.runs.size(), 2u);
    const std::string said = problemsOf(data);
    for (const char* part :
         {"runs/faster': frames.csv was altered", "runs/shorter': frames.csv has 21 bytes, expected 27",
          "1 of 2 runs are from an older build"})
        EXPECT_NE(said.find(part), std::string::npos) << part << " in\n" << said;
}

TEST(ReportPage, NamesEveryKindOfDamageAndIsWritten) {
    const Folder folder;
    const fs::path runs = folder.path() / "runs";
    folder.write("runs/good/run.json", runJson("good", "\"frame_ms_median\": 1e-310, \"repetition\": 1"));
    folder.write("runs/words/run.json", runJson("words", "\"frame_ms_median\": \"abc\""));
    folder.write("runs/many/run.json", runJson("many", "\"repetition\": 2147483647"));
    folder.write("runs/digits/run.json",
                 runJson("digits", "\"frame_ms_median\": 2, \"invalid\": \"" + std::string(50'000, '7') + "\"",
                         std::string(50'000, '7')));
    folder.write("runs/names/run.json", runJson("names", "\"frame_ms_median\": 2, \"drive\": \"__proto__\""));
    folder.write("runs/pipes/notes", "");
    ASSERT_EQ(mkfifo((runs / "pipes/run.json").c_str(), 0600), 0);
    fs::create_symlink("round", runs / "round");
    folder.write("runs/looped/notes", "");
    fs::create_symlink("run.json", runs / "looped/run.json");
    fs::create_symlink("summary.csv", folder.path() / "summary.csv");
    fs::create_symlink("experiments.csv", folder.path() / "experiments.csv");
    fs::create_symlink("/dev/zero", runs / "good/frames.csv");
    fs::create_symlink("images", runs / "good/images");
    const ReportData data = readReport(folder.path(), 1'000'000);
    EXPECT_EQ(data.runs.size(), 3u);
    const std::string said = problemsOf(data);
    for (const char* part : {"words/run.json", "summary.frame_ms_median: got 'abc'", "many/run.json",
                             "allowed: 1..1000", "pipes/run.json: is a pipe", "runs/round: Too many levels",
                             "looped/run.json: cannot be read", "frame times of 2 runs cannot be read"})
        EXPECT_NE(said.find(part), std::string::npos) << part << " in\n" << said;
    EXPECT_EQ(data.warnings.size(), 3u);  // slow, the digits, and invalid
    EXPECT_TRUE(fs::exists(writePage(folder.path(), data)));
}

}  // namespace dustbench::report
