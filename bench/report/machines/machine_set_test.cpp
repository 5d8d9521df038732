#include "bench/report/machines/machine_set.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "bench/report/folder_fixture.h"
#include "bench/report/machines/machine_fixture.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::report {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::string quoted(const std::string& text) {
    std::string safe;
    for (const char letter : text) safe += letter == '\n' ? std::string("\\n") : std::string(1, letter);
    return "\"" + safe + "\"";
}

/// The runs as a results folder that the program could have written.
void writeRuns(const Folder& folder, const std::string& name, const results::StoredRuns& runs) {
    for (const auto& [id, run] : runs) {
        std::string summary, provenance;
        for (const auto& [column, text] : run.cells)
            summary += fmt::format("{}\"{}\": {}", summary.empty() ? "" : ", ", column,
                                   files::numberOf(text) ? text : quoted(text));
        for (const auto& [field, text] : run.provenance) provenance += fmt::format("\"{}\": {}, ", field, quoted(text));
        folder.write(fmt::format("{}/runs/{}/run.json", name, id),
                     fmt::format(R"({{"run_id": "{}", "status": "done", "reason": "", "parameters": {{"particles": {}}},
 "state_hash": "{}", "method_hash": null, "summary": {{{}}}, "provenance": {{{}"inputs": []}}, "warnings": []}})",
                                 id, run.parameters.at("particles"), run.stateHash, summary, provenance));
    }
}

std::string messageOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST(MachineSet, NamesFoldersByAsManyPartsAsItTakes) {
    EXPECT_THAT(folderLabels({"/x/lab", "/x/home/"}), ElementsAre("lab", "home"));
    EXPECT_THAT(folderLabels({"/x/lab/out", "/x/home/out"}), ElementsAre("lab/out", "home/out"));
    EXPECT_THAT(folderLabels({"/out", "/x/out"}), ElementsAre("/out", "x/out"));
}

TEST(MachineSet, RefusesLabelsThatDoNotTellFoldersApart) {
    const Folder folder;
    for (const char* name : {"a", "b"}) writeRuns(folder, name, storedRuns(session(1, 0.5, {200}), "A"));
    const std::vector<fs::path> both{folder.path() / "a", folder.path() / "b"};
    const auto asked = [&](const std::vector<std::string>& labels) {
        return messageOf([&] { (void)readMachines(both, labels); });
    };
    EXPECT_EQ(asked({"x"}), "--label: got 1 for 2 folders, allowed: one for each, or none");
    EXPECT_EQ(asked({"x", "x"}), "--label: got 'x', 'x', expected different labels");
    EXPECT_THAT(asked({"x", ""}), HasSubstr("allowed: 1..60 printable characters"));
    EXPECT_THAT(asked({"x", std::string(61, 'y')}), HasSubstr("allowed: 1..60 printable characters"));
    EXPECT_THAT(asked({"x", "y\nz"}), HasSubstr("allowed: 1..60 printable characters"));
    EXPECT_EQ(asked({"x", "y"}), "no error");
    EXPECT_THAT(messageOf([&] {
                    (void)readMachines({both[0], folder.path() / "b/../a"}, {});
                }),
                HasSubstr("given more than once"));
}

TEST(MachineSet, CopiedRunsAreNoMeasurementsOfAnotherMachine) {
    results::StoredRuns runs = storedRuns(session(1, 0.5, {200}), "A");
    for (auto& [id, run] : runs) run.provenance["started_utc"] = "2026-01-02T03:04:05Z";
    const MachineComparison comparison = compared({{"a", runs}, {"b", runs}});
    EXPECT_FALSE(comparison.isComparable());
    EXPECT_THAT(comparison.remarks.notes,
                Contains("b: 12 of 12 runs were copied from another folder and are left out"));
}

TEST(MachineSet, NamesADamagedRunAndAFolderWithoutRuns) {
    const Folder folder;
    for (const char* name : {"a", "b"}) writeRuns(folder, name, storedRuns(session(1, 0.5, {200}), name));
    folder.write("b/runs/fog-64x48-200-s1-r3/run.json", "{ damaged");
    const MachineComparison comparison = comparisonOf(readMachines({folder.path() / "a", folder.path() / "b"}, {}));
    EXPECT_THAT(comparison.set.labels, ElementsAre("a", "b"));
    EXPECT_THAT(comparison.remarks.notes,
                Contains(AllOf(HasSubstr("b: left out: "), HasSubstr("fog-64x48-200-s1-r3"))));
    EXPECT_EQ(ratioOfHaze(comparison).worlds.at(0).sides[0].result.pairs, 6u);
    EXPECT_EQ(ratioOfHaze(comparison).worlds.at(0).sides[1].result.pairs, 5u);

    fs::create_directories(folder.path() / "c" / "runs");
    for (const char* name : {"c", "d"})
        EXPECT_THAT(messageOf([&] {
                        (void)readMachines({folder.path() / "a", folder.path() / name}, {});
                    }),
                    HasSubstr(fmt::format("{}'", (folder.path() / name).string())));
}

TEST(MachineRemarks, NameACellThatAMachineLacks) {
    results::StoredRuns less = storedRuns(session(1, 0.5, {200}), "B");
    results::StoredRun failed = madeRun({"haze", 1000, 1, 1, 1}, "B");
    failed.status = results::RunStatus::failed;
    failed.reason = "it broke";
    less.emplace(failed.runId, failed);
    const auto comparison = compared({{"more", storedRuns(session(1, 0.5), "A")}, {"less", less}});
    ASSERT_THAT(comparison.remarks.missing, SizeIs(2));
    EXPECT_EQ(comparison.remarks.missing[0].cell, "fog particles=1000");
    EXPECT_THAT(comparison.remarks.missing[0].on, ElementsAre(0));
    EXPECT_THAT(comparison.remarks.missing[0].lacking,
                ElementsAre(std::pair<std::size_t, std::string>(1, "not measured")));
    EXPECT_EQ(comparison.remarks.missing[1].cell, "haze particles=1000");
    EXPECT_THAT(comparison.remarks.missing[1].lacking,
                ElementsAre(std::pair<std::size_t, std::string>(1, "failed: it broke")));
    EXPECT_TRUE(comparison.isComparable());
}

TEST(MachineRemarks, SayOnceWhichSettingsKeepMachinesApart) {
    std::vector<MadeRun> large = session(1, 0.5);
    for (MadeRun& run : large) run.size = "640x480";
    const auto apart = compared({{"small", storedRuns(session(1, 0.5), "A")}, {"large", storedRuns(large, "B")}});
    EXPECT_THAT(apart.remarks.apart, ElementsAre("size: 640x480 on large; 64x48 on small"));
    EXPECT_THAT(apart.remarks.missing, IsEmpty());
    EXPECT_FALSE(apart.isComparable());
    // A third machine that shares configurations with one of them.
    const auto some = compared({{"small", storedRuns(session(1, 0.5), "A")},
                                {"large", storedRuns(large, "B")},
                                {"third", storedRuns(session(2, 0.5), "C")}});
    EXPECT_TRUE(some.isComparable());
    EXPECT_THAT(some.remarks.apart, ElementsAre("size: 640x480 on large; 64x48 on small and third"));
    EXPECT_THAT(some.remarks.notes, Contains("large: none of its configurations was measured on another machine"));
}

TEST(MachineRemarks, NameAMethodOfOneMachineAlone) {
    std::vector<MadeRun> fogAlone = session(1, 0.5);
    std::erase_if(fogAlone, [](const MadeRun& run) { return run.method == "haze"; });
    const auto comparison = compared({{"a", storedRuns(session(1, 0.5), "A")}, {"b", storedRuns(fogAlone, "B")}});
    EXPECT_THAT(comparison.remarks.apart, ElementsAre("method haze: only on a"));
    EXPECT_THAT(comparison.remarks.missing, IsEmpty());
}

TEST(MachineRemarks, SayThatTwoFoldersAreOfOneMachine) {
    const auto same =
        compared({{"before", storedRuns(session(1, 0.5), "A")}, {"after", storedRuns(session(1, 0.5), "A")}});
    EXPECT_THAT(same.remarks.notes,
                Contains("after and before are the same machine, or two identical ones: CPU, cores, "
                         "memory and graphics are equal"));
    const auto two = compared({{"a", storedRuns(session(1, 0.5), "A")}, {"b", storedRuns(session(1, 0.5), "B")}});
    EXPECT_THAT(two.remarks.notes, Not(Contains(HasSubstr("the same machine"))));
}

TEST(MachineRemarks, SayThatTheRunsOfOneMachineAreOfSeveralPrograms) {
    results::StoredRuns mixed = storedRuns(session(1, 0.5), "A");
    mixed.begin()->second.provenance["git_commit"] = "fedcba9876543210";
    // Nothing is shown of a run that did not complete, so its commit does not count.
    results::StoredRuns failed = storedRuns(session(1, 0.5), "B");
    failed.begin()->second.provenance["git_commit"] = "fedcba9876543210";
    failed.begin()->second.status = results::RunStatus::failed;
    const auto comparison = compared({{"a", mixed}, {"b", failed}});
    EXPECT_THAT(comparison.remarks.notes,
                Contains("a: its runs differ in git_commit: 0123456789abcdef, fedcba9876543210"));
    EXPECT_THAT(comparison.remarks.notes, Not(Contains(HasSubstr("b: its runs differ"))));
}

TEST(MachineRemarks, SayThatProgramsAndRenderersDiffer) {
    results::StoredRuns other = storedRuns(session(1, 0.5), "B");
    for (auto& [id, run] : other) {
        run.provenance["git_commit"] = "fedcba9876543210";
        run.provenance["gl_renderer"] = "llvmpipe (LLVM 15.0.6, 256 bits)";
        run.cells["threads"] = "16";
    }
    const auto comparison = compared({{"a", storedRuns(session(1, 0.5), "A")}, {"b", other}});
    EXPECT_THAT(comparison.remarks.programs, ElementsAre("commit: 0123456789ab on a; fedcba987654 on b"));
    EXPECT_THAT(comparison.remarks.notes,
                Contains("drawn by a GPU on a; a software renderer on b: drawing takes a different share of a frame"));
    EXPECT_THAT(comparison.remarks.notes, Contains("CPU threads of a run: 16 on b; 2 on a"));
    const auto row = std::ranges::find(comparison.hardware, "commit", &HardwareRow::name);
    EXPECT_TRUE(row->differs());
    EXPECT_THAT(row->values, ElementsAre("0123456789ab", "fedcba987654"));
    const auto memory = std::ranges::find(comparison.hardware, "memory", &HardwareRow::name);
    EXPECT_THAT(memory->values, ElementsAre("8.0 GiB", "8.0 GiB"));
    EXPECT_FALSE(memory->differs());
}

TEST(MachinesPage, IsWrittenToAFileOrAFolderAndOverNothingElse) {
    const Folder folder;
    for (const char* name : {"a", "b"}) writeRuns(folder, name, storedRuns(session(1, 0.5, {200}), name));
    const MachineComparison comparison = comparisonOf(readMachines({folder.path() / "a", folder.path() / "b"}, {}));
    EXPECT_EQ(writeMachinesPage(folder.path() / "new/page.html", comparison), folder.path() / "new/page.html");
    EXPECT_EQ(writeMachinesPage(folder.path() / "other", comparison), folder.path() / "other/index.html");
    EXPECT_EQ(writeMachinesPage(folder.path() / "other", comparison), folder.path() / "other/index.html");
    folder.write("mine.html", "my garden");
    EXPECT_THAT(messageOf([&] { (void)writeMachinesPage(folder.path() / "mine.html", comparison); }),
                HasSubstr("was not written by dustbench"));
    EXPECT_THAT(messageOf([&] { (void)writeMachinesPage(folder.path() / "a", comparison); }),
                HasSubstr("where that folder's own report is"));
    EXPECT_FALSE(fs::exists(folder.path() / "a/index.html"));
}

TEST(MachinesJson, LetsNoTextBecomeMarkup) {
    const auto comparison = compared({{"</script><b>", storedRuns(session(1, 0.5, {200}), "<i>\xff")},
                                      {"b", storedRuns(session(1, 0.5, {200}), "B")}});
    EXPECT_THAT(machinesJson(comparison), Not(HasSubstr("<")));
}

}  // namespace dustbench::report
