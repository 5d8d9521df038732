// Options of every command: --data, also without it, wherever the program was moved, and --adapter.
#include <gmock/gmock.h>

#include <algorithm>

#include "bench/cli/called_program.h"
#include "bench/measure/provenance.h"
#include "bench/results/freshness.h"
#include "bench/results/stored_run.h"
#include "methods/kit/gpu/egl_context.h"

namespace dustbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Data : public Dustbench {
 protected:
    void SetUp() override {
        Dustbench::SetUp();
        unsetenv("DUSTBENCH_DATA");
    }
    void write(const std::string& name, const std::string& text) const {
        fs::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << text;
    }
    [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
    /// The scene `name` in a data folder, with a wind that no delivered scene has.
    void writeScene(const std::string& name) const { write(name, "description = \"of a test\"\nwind = [3, 0, 1]\n"); }
    [[nodiscard]] results::StoredRun onlyRun(const std::string& folder) const {
        const results::StoredRuns stored = results::readStoredRuns(folder);
        EXPECT_EQ(stored.size(), 1u);
        return stored.begin()->second;
    }
};

TEST_F(Data, OfAFolderAddNamesBeforeOrAfterTheSubcommandAndByTheEnvironment) {
    writeScene("mine/scenes/hills.toml");
    writeScene("theirs/scenes/lake.toml");
    const auto expectBoth = [](const Called& listed) {
        EXPECT_EQ(listed.code, 0) << listed.err;
        EXPECT_THAT(listed.out, AllOf(HasSubstr("hills"), HasSubstr("lake"), HasSubstr("plain")));
    };
    const std::string mine = "--data " + at("mine"), theirs = "--data " + at("theirs");
    expectBoth(call(mine + " " + theirs + " list scenes"));
    expectBoth(call("list scenes " + mine + " " + theirs));
    expectBoth(call(mine + " list scenes " + theirs));
    setenv("DUSTBENCH_DATA", (at("mine") + ":" + at("theirs")).c_str(), 1);
    expectBoth(call("list scenes"));
    EXPECT_THAT(call("list scenes " + theirs).out, AllOf(HasSubstr("lake"), Not(HasSubstr("hills"))));
    unsetenv("DUSTBENCH_DATA");
}

TEST_F(Data, OfAFolderReachTheProcessesOfRunsAndSuites) {
    writeScene("mine/scenes/hills.toml");
    write("mine/suites/hilly.toml", fmt::format("title = \"hilly\"\nmethods = [\"{}\"]\nscenes = [\"hills\"]\n"
                                                "sizes = [\"64x48\"]\nframes = 1\nwarmup = 0\n[parameters]\n"
                                                "preroll = 0\nparticles = 50\n",
                                                methods().front().id));
    const Called run = shortRun("--frames 1 --scene hills --data " + at("mine") + " --out " + at("run"));
    ASSERT_EQ(run.code, 0) << run.err;
    const Called suite = call("--data " + at("mine") + " suite hilly --out " + at("suite"));
    ASSERT_EQ(suite.code, 0) << suite.err;
    for (const char* folder : {"run", "suite"}) {
        const results::StoredRun stored = onlyRun(at(folder));
        const auto isScene = [](const measure::InputHash& input) { return input.file == "scenes/hills.toml"; };
        EXPECT_TRUE(std::ranges::any_of(stored.inputs, isScene)) << folder;
    }
}

TEST_F(Data, OfAFolderThatIsMissingIsOneLineAndExitCodeThree) {
    writeScene("mine/scenes/hills.toml");
    for (const std::string& arguments :
         {"list scenes --data " + at("mime"), "--data " + at("mime") + " list scenes",
          "list suites --data " + at("mine") + " --data " + at("mime"), "env --data " + at("mime"),
          "list scenes --data " + at("mine/scenes"), "list scenes --data " + at("mine/scenes/hills.toml")}) {
        const Called called = call(arguments);
        EXPECT_EQ(called.code, 3) << arguments;
        EXPECT_EQ(called.out, "") << arguments;
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
        EXPECT_THAT(called.err, HasSubstr("--data: '")) << arguments;
    }
    EXPECT_THAT(call("list scenes --data " + at("mime")).err, HasSubstr("did you mean '" + at("mine") + "'?"));
    setenv("DUSTBENCH_DATA", at("mime").c_str(), 1);
    const Called called = call("list scenes");
    unsetenv("DUSTBENCH_DATA");
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("DUSTBENCH_DATA: '"));
}

TEST_F(Data, LieBesideTheProgramWhereverBothAreMoved) {
    const fs::path program = DUSTBENCH_PROGRAM, source = program.parent_path().parent_path().parent_path();
    for (const auto& [bin, data] :
         {std::pair{"tree/build/release", "tree/data"}, {"prefix/bin", "prefix/share/dustbench"}}) {
        fs::create_directories(folder_ / bin);
        for (const char* file : {"dustbench", "libdustbench_kit.so"})
            if (fs::exists(program.parent_path() / file))
                fs::copy_file(program.parent_path() / file, folder_ / bin / file);
        fs::create_directories((folder_ / data).parent_path());
        fs::copy(source / "data", folder_ / data, fs::copy_options::recursive);
    }
    fs::create_directories(folder_ / "tree/reports");
    fs::copy(source / "reports" / "page", folder_ / "tree/reports/page", fs::copy_options::recursive);
    for (const char* document : {"SCHEMA.md", "METRICS.md"})
        fs::copy_file(source / "reports" / document, folder_ / "tree/reports" / document);
    fs::rename(folder_ / "tree", folder_ / "moved");
    writeScene("moved/data/scenes/only_here.toml");
    writeScene("prefix/share/dustbench/scenes/only_here.toml");
    for (const char* place : {"moved/build/release/dustbench", "prefix/bin/dustbench"}) {
        const Called listed = callAs(at(place), "list scenes");
        EXPECT_EQ(listed.code, 0) << listed.err;
        EXPECT_THAT(listed.out, AllOf(HasSubstr("only_here"), HasSubstr("plain")));
    }
    const std::string moved = at("moved/build/release/dustbench");
    const Called run = callAs(moved, "run --scene only_here --method " + methods().front().id +
                                         " --size 64x48 --warmup 0 --frames 1 -P preroll=0 --out " + out());
    EXPECT_EQ(run.code, 0) << run.err;
    const Called report = callAs(moved, "report " + out());
    EXPECT_EQ(report.code, 0) << report.err;
    fs::remove_all(folder_ / "moved/data");
    const Called without = callAs(moved, "list scenes");
    EXPECT_EQ(without.code, 3);
    EXPECT_THAT(without.err, HasSubstr("its files are missing, expected in '" + at("moved/data") + "'"));
}

TEST_F(Data, OfTheTreeAreNotNamedByTheProgramItself) {
    if (measure::buildFacts().buildType != "Release") GTEST_SKIP() << "debug symbols name the sources";
    const fs::path folder = fs::path(DUSTBENCH_PROGRAM).parent_path(), source = folder.parent_path().parent_path();
    for (const char* name :
         {"dustbench", "libdustbench_kit.so", "libdustbench_openvdb.so", "libdustbench_pictures.so"}) {
        if (!fs::exists(folder / name)) continue;  // a statically linked program has no kit next to it
        const std::string content = contentOf(folder / name);
        EXPECT_EQ(content.find(source.string()), std::string::npos) << name;
    }
}

TEST_F(Data, AFileStandsWhereverANameDoes) {
    writeScene("suites/hills.toml");
    std::ofstream(folder_ / "suites/hills.toml", std::ios::app) << "drive = \"loop.csv\"\n";
    write("suites/loop.csv", "time_s,target_speed_mps,steer\n0,10,0\n60,10,0\n");
    write("suites/mine.toml", fmt::format("title = \"mine\"\nmethods = [\"{}\"]\nscenes = [\"hills.toml\"]\n"
                                          "drives = [\"\", \"./loop.csv\"]\nsizes = [\"64x48\"]\nframes = 1\n"
                                          "warmup = 0\n[parameters]\npreroll = 0\nparticles = 50\n",
                                          methods().front().id));
    const Called suite = call("suite " + at("suites/mine.toml") + " --out " + out());
    ASSERT_EQ(suite.code, 0) << suite.err;
    EXPECT_EQ(runs(out()).size(), 2u);
    const Called lost = call("suite " + at("suites/mime.toml") + " --out " + out());
    EXPECT_EQ(lost.code, 3);
    EXPECT_THAT(lost.err, AllOf(HasSubstr("no such file"), HasSubstr("mine.toml'?")));
}

/// Methods with a parameter that refers to a data file, and that parameter.
std::vector<std::pair<std::string, Parameter>> fileParameters() {
    std::vector<std::pair<std::string, Parameter>> found;
    for (const MethodInfo& info : methods())
        for (const Parameter& parameter : info.parameters.all())
            if (!parameter.fileExtension.empty()) {
                found.emplace_back(info.id, parameter);
                std::string& extension = found.back().second.fileExtension;
                extension = extension.substr(0, extension.find('|'));
            }
    return found;
}

TEST_F(Data, OfAMethodMayBeAFileThatTheRunKnowsByItsContent) {
    const fs::path data = fs::path(DUSTBENCH_PROGRAM).parent_path().parent_path().parent_path() / "data";
    for (const auto& [method, parameter] : fileParameters()) {
        const fs::path delivered = data / parameter.dataFolder / (parameter.initial + parameter.fileExtension);
        const std::string name = parameter.name + "/own" + parameter.fileExtension;
        write(name, contentOf(delivered));
        const std::string rest = " --size 64x48 --warmup 0 --frames 1 -P preroll=0 -P particles=50 --out ";
        const std::string set = "run --method " + method + " -P " + parameter.name + "=";
        const Called called = call(set + at(name) + rest + at(method));
        ASSERT_EQ(called.code, 0) << called.err;
        const results::StoredRun run = onlyRun(at(method));
        EXPECT_EQ(run.parameters.at(parameter.name), at(name));
        const auto isFile = [&](const measure::InputHash& input) { return input.file == at(name); };
        EXPECT_TRUE(std::ranges::any_of(run.inputs, isFile)) << method;
        const Called lost = call(set + at(parameter.name + "/owm" + parameter.fileExtension) + rest + at("lost"));
        EXPECT_EQ(lost.code, 3);
        EXPECT_THAT(lost.err, AllOf(HasSubstr("no such file"), HasSubstr("own" + parameter.fileExtension)));
        EXPECT_FALSE(fs::exists(at("lost"))) << "found before a folder is made";
    }
}

TEST_F(Data, ThatFilesNameLieBesideThemAndMakeResultsOutdatedWhenTheyChange) {
    const std::string cube =
        "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    write("own/shape.toml", "description = \"of a test\"\nmesh = \"box.obj\"\nparticles = 100\nresolution = 4\n");
    write(
        "own/particles.toml",
        "emission = { part = \"stream\", rate_per_second = 50 }\nposition = { part = \"mesh\", at = \"place\", mesh = "
        "\"./box.obj\" }\nvelocity = { part = \"random\" }\ncolour = { part = \"constant\" }\nsize = { part = "
        "\"constant\" }\nlife = [ { part = \"lifetime\" } ]\n");
    for (const auto& [method, parameter] :
         {std::pair<std::string, std::string>{"voxel_shape", "shape=" + at("own/shape.toml")},
          {"plugin_particles", "system=" + at("own/particles.toml")}}) {
        if (std::ranges::find(methods(), method, &MethodInfo::id) == methods().end()) continue;
        write("own/box.obj", cube);
        const Called called = call("run --method " + method + " -P " + parameter +
                                   " --size 64x48 --warmup 0 --frames 1 -P preroll=0 --out " + at(method));
        ASSERT_EQ(called.code, 0) << called.err;
        const results::StoredRun run = onlyRun(at(method));
        const std::string build = run.provenance.at("build_id");
        EXPECT_EQ(results::Freshness(build).whyOutdated(run), "") << method;
        write("own/box.obj", cube + "# changed\n");
        EXPECT_THAT(results::Freshness(build).whyOutdated(run), HasSubstr("box.obj has changed since")) << method;
    }
}

// --- --adapter and the adapters listed by `env`, on any machine

std::vector<gpu::Adapter> usableAdapters() {
    std::vector<gpu::Adapter> adapters = gpu::listAdapters();
    std::erase_if(adapters, [](const gpu::Adapter& each) { return !each.problem.empty(); });
    return adapters;
}

std::map<std::string, std::string, std::less<>> provenanceOfOnlyRun(const std::string& folder) {
    const results::StoredRuns stored = results::readStoredRuns(folder);
    EXPECT_EQ(stored.size(), 1u);
    return stored.begin()->second.provenance;
}

TEST_F(Dustbench, ARunDrawsWithTheAdapterThatItIsToldBeforeOrAfterTheSubcommand) {
    const std::string run =
        "run --method " + methods().front().id + " --size 96x72 --warmup 2 --frames 1 -P preroll=0 --out ";
    const std::vector<gpu::Adapter> adapters = usableAdapters();
    ASSERT_FALSE(adapters.empty());
    for (const gpu::Adapter& adapter : adapters) {
        const std::string before = fmt::format("{}-before-{}", out(), adapter.index), after = before + "-after";
        const Called first = call(fmt::format("--adapter {} {}'{}'", adapter.index, run, before));
        ASSERT_EQ(first.code, 0) << first.err;
        const Called second = call(fmt::format("{}'{}' --adapter '{}'", run, after, adapter.name));
        ASSERT_EQ(second.code, 0) << second.err;
        for (const auto& [folder, why] :
             {std::pair{before, std::to_string(adapter.index)}, std::pair{after, adapter.name}}) {
            auto provenance = provenanceOfOnlyRun(folder);
            EXPECT_EQ(provenance["adapter"], adapter.name);
            EXPECT_EQ(provenance["adapter_index"], std::to_string(adapter.index));
            EXPECT_EQ(provenance["adapter_why"], "--adapter " + why);
            EXPECT_EQ(provenance["gl_renderer"], adapter.renderer);
            EXPECT_EQ(provenance["gl_platform"], platformName(adapter.platform));
        }
    }
}

TEST_F(Dustbench, ARunThatIsToldNoAdapterSaysWhichItTookAndWhy) {
    const Called called = shortRun("--frames 1 --out " + out());
    ASSERT_EQ(called.code, 0) << called.err;
    const std::vector<gpu::Adapter> adapters = gpu::listAdapters();
    const std::size_t preferred = *gpu::preferredAdapter(adapters);
    auto provenance = provenanceOfOnlyRun(out());
    EXPECT_EQ(provenance["adapter"], adapters[preferred].name);
    EXPECT_EQ(provenance["adapter_why"], gpu::whyPreferred(adapters, preferred));
}

TEST_F(Dustbench, AnUnknownAdapterIsOneLineThatNamesThoseThatThereAre) {
    const std::string run = "run --method " + methods().front().id + " --out " + out();
    for (const std::string& arguments :
         {"--adapter nosuch " + run, run + " --adapter 99",
          "compare null_method:entry=first null_method:entry=second "
          "--adapter=nosuch --out " +
              out(),
          "export --method " + methods().front().id + " --frames 0:1:1 --adapter nosuch --out " + out(),
          std::string("env --adapter nosuch")}) {
        const Called called = call(arguments);
        EXPECT_EQ(called.code, 3) << arguments << "\n" << called.err;
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
        for (const gpu::Adapter& adapter : gpu::listAdapters()) EXPECT_THAT(called.err, HasSubstr(adapter.name));
        EXPECT_EQ(called.out, "");
        EXPECT_FALSE(fs::exists(out())) << arguments;
    }
    EXPECT_THAT(call("--adapter 0 lst").err, HasSubstr("'list'"));
}

TEST_F(Dustbench, EnvListsTheAdaptersAndMarksTheOneThatIsTaken) {
    const auto count = [](const std::string& text, const std::string& part) {
        std::size_t found = 0;
        for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++found;
        return found;
    };
    const std::string text = call("env").out;
    for (const gpu::Adapter& adapter : gpu::listAdapters())
        EXPECT_THAT(text, HasSubstr(fmt::format("{}: {}, ", adapter.index, adapter.name)));
    EXPECT_EQ(count(text, "; chosen: "), 1u) << text;
    for (const gpu::Adapter& adapter : usableAdapters()) {
        const std::string json = call(fmt::format("env --json --adapter {}", adapter.index)).out;
        EXPECT_EQ(count(json, "\"problem\": "), gpu::listAdapters().size()) << json;
        EXPECT_EQ(count(json, "\"chosen\": true"), 1u) << json;
        EXPECT_THAT(json, HasSubstr(fmt::format("\"adapter_index\": {},", adapter.index)));
    }
}

}  // namespace
}  // namespace dustbench::cli
