// The interface to OpenImageIO, in a library that is loaded on first use.
//
// Linking OpenImageIO and its 250 or so libraries took most of every start, and the files that runs read and write do
// not need it (picture_files.h). openimageio/ implements this interface; it is built as libdustbench_pictures.so next
// to the kit.
// Units: pixels, rows from the top. Errors: returned as text, empty on success. Threads: any; calls are independent.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "methods/kit/pictures/colour_encoding.h"

namespace dustbench::pictures {

/// A 2D picture as stored in its file, values as floats (0..1 for integer formats).
struct StoredPicture {
    int width = 0, height = 0, channels = 0;
    int alphaChannel = -1;                    ///< -1: none
    ColourEncoding encoding;                  ///< of the colours; the values are as stored
    bool isPremultiplied = false;             ///< by alpha
    std::vector<float> values;                ///< pixel by pixel
    std::vector<std::string> channelNames{};  ///< empty: grey or RGB, and alpha
    std::vector<std::string> ignored{};       ///< other contents of the file: `layers`
};

class PictureLibrary {
 public:
    virtual ~PictureLibrary() = default;

    [[nodiscard]] virtual std::string read(const std::filesystem::path& file, StoredPicture& picture) const = 0;
    /// Reads only width and height.
    [[nodiscard]] virtual std::string readSize(const std::filesystem::path& file, StoredPicture& picture) const = 0;
    /// RGB, sRGB; quality is at most 100. Returns the encoded bytes; writes no file.
    [[nodiscard]] virtual std::string encodeJpeg(int width, int height, std::span<const std::uint8_t> rgb, int quality,
                                                 std::vector<std::uint8_t>& jpeg) const = 0;

    /// RGBA, filtered with a Blackman–Harris window.
    [[nodiscard]] virtual std::string resize(std::span<const float> from, int fromWidth, int fromHeight,
                                             std::span<float> to, int width, int height) const = 0;
};

/// Loads the library on first call. Throws std::runtime_error if it is missing.
[[nodiscard]] DUSTBENCH_API const PictureLibrary& pictureLibrary();

}  // namespace dustbench::pictures
