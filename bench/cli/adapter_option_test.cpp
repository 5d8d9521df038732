// `--adapter` and the adapters listed by `env`, on any machine.
#include <gmock/gmock.h>

#include <algorithm>

#include "bench/cli/called_program.h"
#include "bench/results/stored_run.h"
#include "methods/kit/gpu/egl_context.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;

std::vector<gpu::Adapter> usableAdapters() {
    std::vector<gpu::Adapter> adapters = gpu::listAdapters();
    std::erase_if(adapters, [](const gpu::Adapter& each) { return !each.problem.empty(); });
    return adapters;
}

std::map<std::string, std::string, std::less<>> provenanceOfOnlyRun(const std::string& folder) {
    const bench::StoredRuns stored = bench::readStoredRuns(folder);
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
