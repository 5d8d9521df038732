#include "bench/cli/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "bench/run/child_process.h"
#include "bench/scene/time_step.h"
#include "methods/contract/errors.h"

namespace dustbench::cli {
namespace fs = std::filesystem;
namespace {

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
    const std::string rate = fmt::format("{}/{}", std::lround(1 / bench::stepSeconds), every);
    bench::ChildCommand command;
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
    const bench::ChildOutcome outcome = bench::runChild(command);
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

}  // namespace

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

void writeFilms(const FilmFiles& files, const fs::path& images, std::int64_t every) {
    if (!files.video.empty()) writeFilm("--video", files.video, images, every, videoOptions(files.video));
    if (!files.gif.empty())
        writeFilm("--gif", files.gif, images, every,
                  {"-vf", fmt::format("fps={},split[a][b];[a]palettegen[p];[b][p]paletteuse", gifFramesPerSecond)});
}

}  // namespace dustbench::cli
