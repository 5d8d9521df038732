// Makes a film of the pictures of a run with ffmpeg, after the run, so that it does not affect the times.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace dustbench::cli {

/// Files of `--video` and `--gif`; empty if not requested.
struct FilmFiles {
    std::string video, gif;
    [[nodiscard]] bool wanted() const { return !video.empty() || !gif.empty(); }
};

/// Call before the run. Throws InputError for another file extension, or if ffmpeg is not on the PATH.
void requireFilm(const FilmFiles& files);

/// Writes the films from `images` (f000000.png, …), which contains every `every`-th frame. They play in real time. A
/// file appears only when it is complete. Throws InputError with ffmpeg's message.
void writeFilms(const FilmFiles& files, const std::filesystem::path& images, std::int64_t every);

}  // namespace dustbench::cli
