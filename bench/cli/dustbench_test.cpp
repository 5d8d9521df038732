// End-to-end tests of the program: exit codes, one line on stderr, files and their consistency.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include "bench/cli/called_program.h"
#include "bench/results/compared_runs.h"
#include "bench/results/stored_run.h"
#include "methods/contract/registry.h"
#include "methods/contract/stage_clock.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/part_toml.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;

std::string stateHash(const fs::path& run) {
    const std::string text = contentOf(run / "run.json");
    const std::string key = "\"state_hash\": \"";
    const std::size_t at = text.find(key);
    return at == std::string::npos ? "" : text.substr(at + key.size(), 16);
}

TEST_F(Dustbench, WrongUseIsOneLineAndExitCodeThree) {
    ASSERT_FALSE(methods().empty());
    const std::string method = methods().front().id;
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"", "no command given"},
        {"--bogus", "unknown option '--bogus'"},
        {"lst", "'list'"},
        {"list method", "'methods'"},
        {"run --out o", "--method"},
        {"run --method " + method + "x --out o", "'" + method + "'"},
        {"run --method " + method + " --out o --scene plan", "'plain'"},
        {"run --method " + method + " --out o --drive slalon", "'slalom'"},
        {"run --method " + method + " --out o -P particle=5", "'particles'"},
        {"run --method " + method + " --out o -P particles=-5", "0..10000000"},
        {"run --method " + method + " --out o -P particles=1000000000", "60 GB"},
        {"run --method " + method + " --out o -P particles", "name=value"},
        {"run --method " + method + " --out o -P particles=", "got '', expected a value"},
        {"run --method " + method + " --out o -P particles=1,,2", "on each side of ','"},
        {"run --method " + method + " --out o --frames 0", "1..10000000"},
        {"run --method " + method + " --out o --frames many", "'many'"},
        {"run --method " + method + " --out o --frame 5", "'--frames'"},
        {"run --method " + method + " --out o --size 5", "WIDTHxHEIGHT"},
        {"run --method " + method + " --out o --sync always", "frame|stage|none"},
        {"suite carr2006-fig6 --out o", "'carr2006-fig5'"},
        {"suite /nowhere/suite.toml --out o", "/nowhere/suite.toml"},
        {"suite carr2006-fig5 --order sorted --out o", "interleaved|batch"},
        {"reproduce --paper carr206", "'carr2006'"},
        {"reproduce --paper carr2006 --quick --full --out o", "--full"},
    };
    for (const auto& [arguments, expected] : mistakes) {
        const Called called = call(arguments);
        EXPECT_EQ(called.code, 3) << arguments << "\n" << called.err;
        EXPECT_THAT(called.err, HasSubstr(expected)) << arguments;
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << arguments << "\n" << called.err;
        EXPECT_EQ(called.out, "") << arguments;
    }
}

TEST_F(Dustbench, NothingOfAFileReachesTheTerminalRaw) {
    const auto expectOneLine = [&](const std::string& arguments) {
        const Called called = call(arguments);
        EXPECT_EQ(called.code, 3) << arguments;
        EXPECT_LE(called.err.size(), 1000u) << arguments;
        EXPECT_TRUE(called.err.starts_with("dustbench: ")) << called.err;
        EXPECT_EQ(std::ranges::count_if(called.err, [](unsigned char c) { return c < 32 || c == 127; }), 1)
            << arguments << "\n"
            << called.err;  // the end of the line
    };
    std::ofstream(folder_ / "control.toml") << "methods = [\"a\\u001b[2J\\u0007b\"]\n";
    std::ofstream(folder_ / "long.toml") << "methods = [\"" << std::string(5'000'000, 'x') << "\"]\n";
    std::ofstream(folder_ / "deep.toml") << "a = " << std::string(31'000, '[') << "\n";
    std::ofstream(folder_ / "big.toml")
        << "methods = [\"null_method\"]\n[parameters]\nparticles = \"1:10000:1\"\nspeed = \"0.001:10:0.001\"\n";
    for (const char* name : {"control", "long", "deep", "big"})
        expectOneLine(fmt::format("suite {}/{}.toml --dry-run --out {}", folder_.string(), name, out()));
    fs::create_symlink("loop.toml", folder_ / "loop.toml");
    ASSERT_EQ(mkfifo((folder_ / "pipe.toml").c_str(), 0600), 0);
    for (const char* name : {"loop.toml", "pipe.toml"})
        expectOneLine(fmt::format("suite {}/{} --dry-run --out {}", folder_.string(), name, out()));
    expectOneLine("view --state " + (folder_ / "pipe.toml").string());
    expectOneLine("diff /dev/zero /dev/zero");
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Dustbench, AMalformedFileIsNamedWithItsLine) {
    std::ofstream(folder_ / "broken.toml") << "title = \"x\"\nframes = = 3\n";
    EXPECT_THAT(call(fmt::format("suite {}/broken.toml --out {}", folder_.string(), out())).err,
                HasSubstr("broken.toml:2"));
    std::ofstream(folder_ / "drive.csv") << "time_s,throttle\n0,fast\n";
    const Called drive = shortRun(fmt::format("--frames 1 --drive {}/drive.csv --out {}", folder_.string(), out()));
    EXPECT_EQ(drive.code, 3) << drive.err;
    EXPECT_THAT(drive.err, HasSubstr("drive.csv:"));
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Dustbench, AFolderThatCannotBeWrittenIsFoundBeforeTheFirstRun) {
    std::ofstream(folder_ / "file") << "x";
    const Called called = shortRun("--frames 1 --out " + (folder_ / "file" / "out").string());
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("cannot be written"));
}

TEST_F(Dustbench, HelpAndListsGoToStdout) {
    for (const char* arguments : {"--help", "run --help", "suite --help", "list --help", "--version", "list", "env"}) {
        const Called called = call(arguments);
        EXPECT_EQ(called.code, 0) << arguments << "\n" << called.err;
        EXPECT_FALSE(called.out.empty()) << arguments;
        EXPECT_EQ(called.err, "") << arguments;
    }
    const std::string list = call("list methods").out;
    for (const MethodInfo& method : methods()) {
        EXPECT_THAT(list, HasSubstr(method.id));
        for (const Parameter& parameter : method.parameters.all()) EXPECT_THAT(list, HasSubstr(parameter.name));
    }
    const std::string parts = call("list parts").out;
    for (const particles::PartInfo& part : particles::partTable()) {
        EXPECT_THAT(parts, HasSubstr(fmt::format("{}/{} ", particles::kindName(part.kind), part.name)));
        for (const std::string& text : {part.help, part.source}) EXPECT_THAT(parts, HasSubstr(text));
        for (const Parameter& key : particles::tableKeys(part.parameters))
            EXPECT_THAT(parts, HasSubstr(key.name + " = "));
    }
    const std::string wind = call("list parts force/wind --json").out;
    for (const char* text : {"\"id\": \"force/wind\"", "\"part_kind\": \"force\"", "\"part\": \"wind\"",
                             "\"name\": \"gust_speed\"", "\"unit\": \"m/s\""})
        EXPECT_THAT(wind, HasSubstr(text));
    EXPECT_THAT(call("list scenes relief_wall --json").out, HasSubstr("\"panels\": 2"));
    EXPECT_THAT(call("list suites --json").out, HasSubstr("\"id\": \"carr2006-fig5\""));
    EXPECT_THAT(call("env --json").out, HasSubstr("\"gl_renderer\""));
}

TEST_F(Dustbench, StagesOfEveryFrameAddUpToItsTime) {
    for (const char* sync : {"frame", "stage"}) {
        const std::string folder = out() + sync;
        const Called called = shortRun(fmt::format("--frames 20 --images 8 --sync {} --out {}", sync, folder));
        ASSERT_EQ(called.code, 0) << called.err;
        const fs::path run = runs(folder).at(0);
        const auto frames = files::CsvTable::parseFile(run / "frames.csv");
        ASSERT_EQ(frames.rows(), 20u);
        double frameMs = 0, stagesMs = 0;
        for (std::size_t row = 0; row < frames.rows(); ++row) {
            EXPECT_EQ(frames.number(row, "frame"), static_cast<double>(row));
            frameMs += frames.number(row, "frame_ms");
            for (const std::string_view stage : stageNames) stagesMs += frames.number(row, std::string(stage) + "_ms");
        }
        EXPECT_LE(stagesMs, frameMs);
        EXPECT_GE(stagesMs, 0.95 * frameMs);

        std::vector<std::string> images;
        for (const auto& entry : fs::directory_iterator(run / "images")) images.push_back(entry.path().filename());
        EXPECT_THAT(images, testing::UnorderedElementsAre("f000000.png", "f000000.exr", "f000008.png", "f000008.exr",
                                                          "f000016.png", "f000016.exr"));
        EXPECT_EQ(files::CsvTable::parseFile(fs::path(folder) / "summary.csv").rows(), 1u);
    }
}

TEST_F(Dustbench, RepetitionsDifferInWhatIsMeasuredAndInNothingElse) {
    std::ofstream(folder_ / "twice.toml")
        << "methods = [\"" << methods().front().id
        << "\"]\nsizes = [\"96x72\"]\nframes = 5\nwarmup = 1\nrepetitions = 2\nbaseline = false\n"
           "[parameters]\nparticles = 200\npreroll = 0.2\n";
    const Called called = call(fmt::format("suite {}/twice.toml --out {}", folder_.string(), out()));
    ASSERT_EQ(called.code, 0) << called.err;
    const auto folders = runs(out());
    ASSERT_EQ(folders.size(), 2u);
    const results::StoredRun a = results::readRunFile(folders[0] / "run.json");
    const results::StoredRun b = results::readRunFile(folders[1] / "run.json");
    const auto differing = [](const auto& first, const auto& second) {
        std::vector<std::string> names;
        EXPECT_EQ(first.size(), second.size());
        for (const auto& [name, value] : first)
            if (second.at(name) != value) names.push_back(name);
        return names;
    };
    for (const std::string& name : differing(a.provenance, b.provenance))
        EXPECT_THAT(name, testing::AnyOf("started_utc", "load_average", "stolen_share", "clock_reading_ns",
                                         "clock_stage_ns", "key"));
    for (const std::string& name : differing(a.cells, b.cells))
        EXPECT_THAT(name,
                    testing::AnyOf("run_id", "repetition", "start_s", "run_s", "rss_peak_bytes", HasSubstr("_ms_"),
                                   HasSubstr("fps_"), HasSubstr("_us_"), HasSubstr("energy"), HasSubstr("gpu_mhz_")));
    EXPECT_EQ(a.parameters, b.parameters);
    ASSERT_TRUE(a.outputs && a.outputs->size() >= 2);
    EXPECT_EQ(a.outputs->at(0).file, "frames.csv");
    EXPECT_EQ(results::whyAltered(*a.outputs, folders[0]), "");
    EXPECT_EQ(a.stateHash, b.stateHash);
    EXPECT_EQ(a.provenance.at("key").size(), b.provenance.at("key").size());
}

TEST_F(Dustbench, StateHashDependsOnTheSeedAndOnNothingElseOfARun) {
    const auto hash = [this](const std::string& name, const std::string& more) {
        const std::string folder = out() + name;
        const Called called = shortRun(fmt::format("--frames 12 --out {} {}", folder, more));
        EXPECT_EQ(called.code, 0) << called.err;
        return stateHash(runs(folder).at(0));
    };
    const std::string once = hash("a", "--threads 1");
    EXPECT_EQ(once.size(), 16u);
    EXPECT_EQ(hash("b", "--threads 1"), once);
    EXPECT_EQ(hash("c", "--threads 2"), once);
    EXPECT_EQ(hash("d", "--sync none"), once);
    EXPECT_NE(hash("e", "--seed 2"), once);
}

TEST_F(Dustbench, AListOfValuesIsARunEach) {
    const Called called =
        call(fmt::format("run --method {} --size 64x48 --warmup 0 --frames 2 -P preroll=0.1 -P particles=50:150:50 "
                         "-P speed=10,20 --out {}",
                         methods().front().id, out()));
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_EQ(runs(out()).size(), 6u);
    EXPECT_THAT(called.err, HasSubstr("run 6 of 6: "));

    const Called tables = call(fmt::format("report {} --text", out()));
    ASSERT_EQ(tables.code, 0) << tables.err;
    // The cloud has not reached its number of particles: `invalid: …` is a separate line.
    EXPECT_EQ(std::ranges::count(tables.out, '\n'), 3 + 6 + 1 + 1) << tables.out;
    EXPECT_THAT(tables.out, AllOf(HasSubstr(", particles=150 speed=20 "), HasSubstr(" runs ")));
}

TEST_F(Dustbench, ASuitePrintsItsTableAndTheVerdictsThatItAsksFor) {
    std::ofstream(folder_ / "drawn.toml") << fmt::format(
        "title = \"Two sizes of cloud\"\nmethods = [\"{0}\"]\nsizes = [\"64x48\"]\nframes = 3\nwarmup = 0\n"
        "repetitions = 2\n[parameters]\nparticles = [100, 2000]\n[[compare]]\n"
        "of = \"{0} particles=100\"\nwith = \"{0} particles=2000\"\ncolumns = [\"frame_ms_median\"]\n",
        methods().front().id);
    const Called called = call(fmt::format("suite {}/drawn.toml --out {}", folder_.string(), out()));
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(called.out, HasSubstr("Two sizes of cloud\n"));
    EXPECT_THAT(called.out, HasSubstr("medians over 2 runs each\nmethod"));
    for (const std::string_view stage : stageNames) EXPECT_THAT(called.out, HasSubstr(std::string(stage)));
    EXPECT_THAT(called.out, HasSubstr(": UNRESOLVED: 2 paired runs, 6 are needed\n"));
    EXPECT_TRUE(called.out.ends_with("/summary.csv\n")) << called.out;
}

TEST_F(Dustbench, AKilledSuiteLeavesNoHalfRunAndResumes) {
    std::ofstream(folder_ / "long.toml") << fmt::format(
        "title = \"long\"\nmethods = [\"{}\"]\nsizes = [\"64x48\"]\nframes = 30\nwarmup = 0\nrepetitions = 4\nbaseline "
        "= false\n"
        "[parameters]\npreroll = 0.1\nparticles = 100\n",
        methods().front().id);
    const std::string suite = (folder_ / "long.toml").string();
    const pid_t victim = fork();
    if (victim == 0) {
        execl(DUSTBENCH_PROGRAM, DUSTBENCH_PROGRAM, "suite", suite.c_str(), "--out", out().c_str(), nullptr);
        _exit(127);
    }
    const auto visible = [this] {
        std::vector<fs::path> list;
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(fs::path(out()) / "runs", error))
            if (!entry.path().filename().string().starts_with('.')) list.push_back(entry.path());
        return list;
    };
    for (int i = 0; i < 6'000 && visible().empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ASSERT_FALSE(visible().empty());
    std::this_thread::sleep_for(std::chrono::milliseconds(150));  // into the next run
    kill(victim, SIGKILL);
    waitpid(victim, nullptr, 0);
    for (const fs::path& run : visible()) EXPECT_TRUE(fs::exists(run / "run.json") && fs::exists(run / "frames.csv"));

    const Called resumed = call(fmt::format("suite {} --out {}", suite, out()));
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(runs(out()).size(), 4u);
    EXPECT_EQ(files::CsvTable::parseFile(fs::path(out()) / "summary.csv").rows(), 4u);
    EXPECT_THAT(call(fmt::format("suite {} --out {}", suite, out())).err, HasSubstr("4 existing"));
}

TEST_F(Dustbench, CtrlCEndsWithTwoAndLeavesNoHalfRun) {
    const pid_t child = fork();
    if (child == 0) {
        execl(DUSTBENCH_PROGRAM, DUSTBENCH_PROGRAM, "run", "--method", methods().front().id.c_str(), "--frames",
              "1000000", "--size", "64x48", "--out", out().c_str(), nullptr);
        _exit(127);
    }
    const auto begun = [this] {
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(fs::path(out()) / "runs", error)) {
            (void)entry;
            return true;
        }
        return false;
    };
    for (int i = 0; i < 6'000 && !begun(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ASSERT_TRUE(begun());
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Dustbench, CtrlCEndsAnExperimentAtOnce) {
    const fs::path paper = folder_ / "papers" / "long";
    fs::create_directories(paper);
    std::ofstream(paper / "paper.toml") << "id = \"long\"\ntitle = \"t\"\nauthors = \"a\"\nyear = 2006\nvenue = "
                                           "\"v\"\nkey = \"k\"\nsummary = \"s\"\nsuites = []\n"
                                           "experiments = [\"ageing\"]\n";
    const fs::path errors = folder_ / "errors";
    const pid_t child = fork();
    if (child == 0) {
        if (freopen(errors.c_str(), "w", stderr) == nullptr) _exit(126);
        execl(DUSTBENCH_PROGRAM, DUSTBENCH_PROGRAM, "reproduce", "--paper", "long", "--data", folder_.c_str(), "--out",
              out().c_str(), nullptr);
        _exit(127);
    }
    const auto begun = [&] { return contentOf(errors).find("experiment 1 of 1: ageing\n") != std::string::npos; };
    for (int i = 0; i < 6'000 && !begun(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_TRUE(begun()) << contentOf(errors);
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_TRUE(contentOf(errors).ends_with("ageing\naborted; repeat the command to resume\n")) << contentOf(errors);
}

TEST_F(Dustbench, ARunThatTakesTooLongIsATimeoutAndExitCodeOne) {
    std::ofstream(folder_ / "slow.toml") << fmt::format(
        "title = \"slow\"\nmethods = [\"{}\"]\nsizes = [\"64x48\"]\nframes = 1000000\nwarmup = 0\n"
        "[parameters]\npreroll = 0.1\nparticles = 100\n",
        methods().front().id);
    const Called called = call(fmt::format("suite {}/slow.toml --timeout 2 --out {}", folder_.string(), out()));
    EXPECT_EQ(called.code, 1) << called.err;
    ASSERT_EQ(runs(out()).size(), 1u);
    const results::StoredRun run = results::readRunFile(runs(out()).at(0) / "run.json");
    EXPECT_EQ(run.status, results::RunStatus::timeout);
    EXPECT_THAT(run.reason, HasSubstr("not finished after 2 s"));
}

TEST_F(Dustbench, ADryRunOnlyPrintsTheList) {
    const Called called = call("suite carr2006-fig5 --quick --dry-run --out " + out());
    EXPECT_EQ(called.code, 0) << called.err;
    EXPECT_EQ(std::ranges::count(called.out, '\n'), 2 * 2 * 6);
    EXPECT_THAT(called.err, HasSubstr("24 runs"));
    EXPECT_FALSE(fs::exists(out()));
}

}  // namespace
}  // namespace dustbench::cli
