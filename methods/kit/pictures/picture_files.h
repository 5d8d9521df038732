// Pictures as files: what runs read and write by the formats' own libraries, anything else by OpenImageIO.
//
// A run that reads an 8-bit PNG, or writes PNG and EXR, need not load OpenImageIO (picture_library.h).
// Units: pixels, rows from the top. Errors: text that is empty on success. Threads: any; each call by itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "methods/kit/pictures/picture_library.h"

namespace dustbench::pictures {

/// Any file that OpenImageIO reads.
[[nodiscard]] DUSTBENCH_API std::string readPicture(const std::filesystem::path& file, StoredPicture& picture);
/// Straight alpha where there are four channels, else three; sRGB.
[[nodiscard]] std::string writePng(const std::filesystem::path& file, int width, int height, int channels,
                                   std::span<const std::uint8_t> bytes);
/// RGBA, linear, premultiplied.
[[nodiscard]] std::string writeExr(const std::filesystem::path& file, int width, int height,
                                   std::span<const float> values);

}  // namespace dustbench::pictures
