// `dustbench run`: one method in one scene; lists and ranges in -P give several runs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/shared_options.h"
#include "bench/cli/text_table.h"
#include "bench/run/child_process.h"
#include "bench/suite/suite_cells.h"
#include "bench/world/time_step.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/contract/stage_clock.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

namespace fs = std::filesystem;

// --- The film of a run, made with ffmpeg from its pictures after the run, so that it does not affect the times

/// Files of `--video` and `--gif`; empty if not requested.
struct FilmFiles {
    std::string video, gif;
    [[nodiscard]] bool wanted() const { return !video.empty() || !gif.empty(); }
};

constexpr std::array<std::string_view, 4> videoKinds{".mp4", ".mkv", ".mov", ".webm"};
/// A GIF's frame times are whole hundredths of a second, and programs slow down faster ones.
constexpr int gifFramesPerSecond = 25;

/// Empty if it is not on the PATH.
fs::path findFfmpeg() {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const fs::path program = fs::path(folder) / "ffmpeg"; fs::is_regular_file(program)) return program;
    return {};
}

/// The file's name until it is complete. It keeps the extension, from which ffmpeg infers the format.
fs::path partOf(const fs::path& file) {
    return file.parent_path() / (".part-" + file.filename().string());
}

void writeFilm(const char* option, const fs::path& file, const fs::path& images, std::int64_t every,
               const std::vector<std::string>& how) {
    if (file.has_parent_path()) fs::create_directories(file.parent_path());
    const fs::path part = partOf(file), log = part.string() + ".log";
    const std::string rate = fmt::format("{}/{}", std::lround(1 / world::stepSeconds), every);
    run::ChildCommand command;
    command.argv = {findFfmpeg().string(),
                    "-y",
                    "-loglevel",
                    "error",
                    "-framerate",
                    rate,
                    "-pattern_type",
                    "glob",
                    "-i",
                    (images / "f??????.png").string()};
    command.argv.insert(command.argv.end(), how.begin(), how.end());
    command.argv.push_back(part.string());
    command.log = log;
    const run::ChildOutcome outcome = run::runChild(command);
    fs::remove(log);
    if (!outcome.succeeded() || !fs::exists(part)) {
        fs::remove(part);
        throw InputError(
            fmt::format("{}: ffmpeg: {}", option, outcome.succeeded() ? "wrote no file" : outcome.reason()));
    }
    fs::rename(part, file);
}

std::vector<std::string> videoOptions(const fs::path& file) {
    // Chroma is halved, so sizes must be even.
    std::vector<std::string> options{"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"};
    if (file.extension() != ".webm") options.insert(options.end(), {"-crf", "18"});
    return options;
}

/// Call before the run. Throws InputError for another file extension, or if ffmpeg is not on the PATH.
void requireFilm(const FilmFiles& files) {
    if (!files.wanted()) return;
    if (!files.video.empty() && std::ranges::find(videoKinds, fs::path(files.video).extension()) == videoKinds.end())
        throw InputError(fmt::format("--video: got '{}', allowed: a .mp4, .mkv, .mov or .webm file", files.video));
    if (!files.gif.empty() && fs::path(files.gif).extension() != ".gif")
        throw InputError(fmt::format("--gif: got '{}', allowed: a .gif file", files.gif));
    if (findFfmpeg().empty())
        throw InputError(fmt::format("{}: the program ffmpeg is not on the PATH; on Debian, install the package ffmpeg",
                                     files.video.empty() ? "--gif" : "--video"));
}

/// Writes the films from `images` (f000000.png, …), which contains every `every`-th frame. They play in real time. A
/// file appears only when it is complete. Throws InputError with ffmpeg's message.
void writeFilms(const FilmFiles& files, const fs::path& images, std::int64_t every) {
    if (!files.video.empty()) writeFilm("--video", files.video, images, every, videoOptions(files.video));
    if (!files.gif.empty())
        writeFilm("--gif", files.gif, images, every,
                  {"-vf", fmt::format("fps={},split[a][b];[a]palettegen[p];[b][p]paletteuse", gifFramesPerSecond)});
}

// --- The command

struct RunOptions {
    WorldOptions world;
    VolumeOptions volumes{"--volumes"};
    std::int64_t frames = results::RunSpec().frames, images = 0;
    bool metrics = false, force = false;
    std::string sync = "frame", out;
    FilmFiles films;
};

results::RunSpec toSpec(const RunOptions& options) {
    results::RunSpec spec = options.world.toSpec();
    spec.frames = options.frames;
    spec.sync = results::syncs.parse("sync", options.sync);
    spec.imagesEvery = options.films.wanted() ? std::max<std::int64_t>(options.images, 1) : options.images;
    spec.volumes = options.volumes.over({});
    if (options.metrics) spec.metricPlan.emplace();
    results::requireFramesWithinRun(spec);
    return spec;
}

/// Prints the median time of every stage and its share of the median frame time.
void printRun(const suite::PlannedRun& run, const results::ResultsFolder& results) {
    const std::string id = results::runId(run.spec);
    const results::StoredRun& stored = results.runs().at(id);
    std::cout << results.runFolder(id).string() << (run.label.empty() ? "" : "  " + run.label) << "\n";
    if (stored.status != results::RunStatus::done) {
        std::cout << "  " << results::runStatuses.wordOf(stored.status) << ": " << files::printable(stored.reason)
                  << "\n";
        return;
    }
    const auto number = [&stored](const std::string& name) { return suite::numberIn(stored, name).value_or(NAN); };
    const double frameMs = number("frame_ms_median");
    std::vector<std::vector<std::string>> rows{{"  median of", "ms", "share"}};
    rows.push_back({"  frame", fixed(frameMs, 3), "100.0%"});
    for (const std::string_view stage : stageNames) {
        const double ms = number(std::string(stage) + "_ms_median");
        rows.push_back({"  " + std::string(stage), fixed(ms, 3), fixed(100 * ms / frameMs, 1) + "%"});
    }
    std::cout << textTable(rows)
              << fmt::format("  {:.1f} fps, {}{:.0f} particles, {:.0f} primitives\n", number("fps_avg"),
                             suite::numberIn(stored, "frame_ms_p95")
                                 ? fmt::format("95 % of the frames within {:.2f} ms, ", number("frame_ms_p95"))
                                 : "",
                             number("particles_median"), number("primitives_median"));
    if (const std::string why = results::whyInvalid(stored); !why.empty())
        std::cout << "  invalid: " << files::printable(why) << " (left out of claims, fits and verdicts)\n";
    if (const std::string said = measure::saysIgnored(stored.ignored); !said.empty())
        std::cout << "  ignored: " << files::printable(said) << "\n";
    for (const std::string& warning : stored.warnings) std::cout << "  warning: " << files::printable(warning) << "\n";
}

int performRuns(const RunOptions& options) {
    const results::RunSpec spec = toSpec(options);
    const auto plan = suite::expandParameters(spec, findMethod(spec.method), options.world.parameterLists());
    for (const suite::PlannedRun& each : plan) results::requireChangesWithinRun(each.spec);
    if (options.films.wanted() && plan.size() > 1)
        throw InputError(fmt::format("{}: got {} runs, allowed: 1 (a film shows one run)",
                                     options.films.video.empty() ? "--gif" : "--video", plan.size()));
    requireFilm(options.films);
    checkWorlds(plan);
    requireOpenGl();
    results::ResultsFolder results(options.out);
    PlanOptions planOptions;
    planOptions.force = options.force;
    planOptions.retryFailed = true;
    planOptions.redoOutdated = true;
    planOptions.badInputEnds = true;
    const int code = runPlan(plan, 1, results, planOptions);
    for (const suite::PlannedRun& each : plan)
        if (results.runs().contains(results::runId(each.spec)) && code != exitAborted) printRun(each, results);
    if (code == exitOk && options.films.wanted() && suite::doneRun(plan.front(), 1, results.runs()))
        writeFilms(options.films, results.runFolder(results::runId(plan.front().spec)) / "images", spec.imagesEvery);
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
