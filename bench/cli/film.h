// The pictures of a run as a film, put together by the program ffmpeg after the run; nothing of it is timed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace dustbench::cli {

/// Files of `--video` and `--gif`; empty: not wanted.
struct FilmFiles {
    std::string video, gif;
    [[nodiscard]] bool wanted() const { return !video.empty() || !gif.empty(); }
};

/// Call before the run. Throws InputError for a file name of another kind, or if ffmpeg is not on the PATH.
void requireFilm(const FilmFiles& files);

/// Writes the films of `images` (f000000.png, …), of which every `every`-th frame is there, at the world's speed. A
/// file appears whole. Throws InputError with what ffmpeg said.
void writeFilms(const FilmFiles& files, const std::filesystem::path& images, std::int64_t every);

}  // namespace dustbench::cli
