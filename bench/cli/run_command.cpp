// `dustbench run`: one method in one scene; lists and ranges in -P give several runs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/cli/film.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/shared_options.h"
#include "bench/cli/text_table.h"
#include "bench/cli/volume_options.h"
#include "bench/cli/world_options.h"
#include "bench/suite/cell_results.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/contract/stage_clock.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

struct RunOptions {
    WorldOptions world;
    VolumeOptions volumes{"--volumes"};
    std::int64_t frames = bench::RunSpec().frames, images = 0;
    bool metrics = false, force = false;
    std::string sync = "frame", out;
    FilmFiles films;
};

bench::RunSpec toSpec(const RunOptions& options) {
    bench::RunSpec spec = options.world.toSpec();
    spec.frames = options.frames;
    spec.sync = bench::syncs.parse("sync", options.sync);
    spec.imagesEvery = options.films.wanted() ? std::max<std::int64_t>(options.images, 1) : options.images;
    spec.volumes = options.volumes.over({});
    if (options.metrics) spec.metricPlan.emplace();
    bench::requireFramesWithinRun(spec);
    return spec;
}

/// Prints the median time of every stage and its share of the median frame time.
void printRun(const bench::PlannedRun& run, const bench::ResultsFolder& results) {
    const std::string id = bench::runId(run.spec);
    const bench::StoredRun& stored = results.runs().at(id);
    std::cout << results.runFolder(id).string() << (run.label.empty() ? "" : "  " + run.label) << "\n";
    if (stored.status != bench::RunStatus::done) {
        std::cout << "  " << bench::runStatuses.wordOf(stored.status) << ": " << files::printable(stored.reason)
                  << "\n";
        return;
    }
    const auto number = [&stored](const std::string& name) { return bench::numberIn(stored, name).value_or(NAN); };
    const double frameMs = number("frame_ms_median");
    std::vector<std::vector<std::string>> rows{{"  median of", "ms", "share"}};
    rows.push_back({"  frame", fixed(frameMs, 3), "100.0%"});
    for (const std::string_view stage : stageNames) {
        const double ms = number(std::string(stage) + "_ms_median");
        rows.push_back({"  " + std::string(stage), fixed(ms, 3), fixed(100 * ms / frameMs, 1) + "%"});
    }
    std::cout << textTable(rows)
              << fmt::format("  {:.1f} fps, {}{:.0f} particles, {:.0f} primitives\n", number("fps_avg"),
                             bench::numberIn(stored, "frame_ms_p95")
                                 ? fmt::format("95 % of the frames within {:.2f} ms, ", number("frame_ms_p95"))
                                 : "",
                             number("particles_median"), number("primitives_median"));
    if (const std::string why = bench::whyInvalid(stored); !why.empty())
        std::cout << "  invalid: " << files::printable(why) << " (left out of claims, fits and verdicts)\n";
    if (const std::string said = bench::saysIgnored(stored.ignored); !said.empty())
        std::cout << "  ignored: " << files::printable(said) << "\n";
    for (const std::string& warning : stored.warnings) std::cout << "  warning: " << files::printable(warning) << "\n";
}

int performRuns(const RunOptions& options) {
    const bench::RunSpec spec = toSpec(options);
    const auto plan = bench::expandParameters(spec, findMethod(spec.method), options.world.parameterLists());
    for (const bench::PlannedRun& each : plan) bench::requireChangesWithinRun(each.spec);
    if (options.films.wanted() && plan.size() > 1)
        throw InputError(fmt::format("{}: got {} runs, allowed: 1 (a film shows one run)",
                                     options.films.video.empty() ? "--gif" : "--video", plan.size()));
    requireFilm(options.films);
    checkWorlds(plan);
    requireOpenGl();
    bench::ResultsFolder results(options.out);
    PlanOptions planOptions;
    planOptions.force = options.force;
    planOptions.retryFailed = true;
    planOptions.redoOutdated = true;
    planOptions.badInputEnds = true;
    const int code = runPlan(plan, 1, results, planOptions);
    for (const bench::PlannedRun& each : plan)
        if (results.runs().contains(bench::runId(each.spec)) && code != exitAborted) printRun(each, results);
    if (code == exitOk && options.films.wanted() && bench::doneRun(plan.front(), 1, results.runs()))
        writeFilms(options.films, results.runFolder(bench::runId(plan.front().spec)) / "images", spec.imagesEvery);
    return code;
}

}  // namespace

Command runCommand() {
    auto options = std::make_shared<RunOptions>();
    return {"run", "Measure one method in one scene",
            "Parameters with defaults and allowed values: `dustbench list methods`.\n"
            "A list `a,b,c` or a range `a:b:step` (including b) makes one run per value.\n"
            "An existing result is kept unless it failed, another build measured it, or one of its input files has\n"
            "changed.",
            [options](Arguments& arguments) {
                options->world.declare(arguments);
                arguments.integer("--frames", "frames to record", options->frames, 1, 10'000'000);
                arguments.text("--sync", "frame|stage|none",
                               "wait for the GPU after every frame or after every stage, or keep two frames in flight",
                               options->sync);
                arguments.integer("--images", "save every N-th frame from frame 0 on as PNG and EXR; 0: none",
                                  options->images, 0);
                arguments.text(
                    "--video", "FILE",
                    "after the run, make a film of it with ffmpeg (.mp4, .mkv, .mov, .webm); also saves the pictures",
                    options->films.video);
                arguments.text("--gif", "FILE", "the same as a GIF", options->films.gif);
                options->volumes.declareOptional(arguments);
                arguments.flag("--metrics",
                               "after the run, compare five frames and the last 31 with reference images "
                               "(reports/METRICS.md)",
                               options->metrics);
                arguments.flag("--force", "measure again if the result exists", options->force);
                arguments.required("--out", "DIR", "folder for the results; created if missing", options->out);
            },
            [options] { return performRuns(*options); }};
}

}  // namespace dustbench::cli
