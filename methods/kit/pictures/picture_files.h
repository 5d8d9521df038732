// Reads and writes picture files: the formats of runs through their own libraries, all others through OpenImageIO.
//
// A run, which reads 8-bit PNG and writes PNG and EXR, need not load OpenImageIO (picture_library.h).
// Units: pixels, rows from the top. Errors: returned as text, empty on success. Threads: any; calls are independent.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "methods/kit/pictures/picture_library.h"

namespace dustbench::pictures {

/// Reads any file that OpenImageIO can read, within the limits of kit/files/limits.h, which are checked against the
/// header before memory for the pixels is allocated.
[[nodiscard]] DUSTBENCH_API std::string readPicture(const std::filesystem::path& file, StoredPicture& picture);
/// Reads only width and height, which is fast for any size; the rest of `picture` is unchanged.
[[nodiscard]] DUSTBENCH_API std::string readPictureSize(const std::filesystem::path& file, StoredPicture& picture);
/// The parts of the file that remain unused if the first `colours` channels other than alpha are read, and alpha on
/// request: `channel 'Z'`.
[[nodiscard]] DUSTBENCH_API std::vector<std::string> unusedParts(const StoredPicture& picture, int colours,
                                                                 bool usesAlpha);
/// sRGB; four channels include straight alpha, else three.
[[nodiscard]] std::string writePng(const std::filesystem::path& file, int width, int height, int channels,
                                   std::span<const std::uint8_t> bytes);
/// The same in memory: the bytes of the file.
[[nodiscard]] std::string encodePng(int width, int height, int channels, std::span<const std::uint8_t> bytes,
                                    std::string& png);
/// RGBA, linear, premultiplied.
[[nodiscard]] std::string writeExr(const std::filesystem::path& file, int width, int height,
                                   std::span<const float> values);

}  // namespace dustbench::pictures
