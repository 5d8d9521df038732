// The interface to OpenImageIO, in a library that is loaded on first use, and what both picture libraries know of
// files: their limits, and how they encode colours.
//
// Linking OpenImageIO and its 250 or so libraries took most of every start, and the files that runs read and write do
// not need it (picture_files.h). openimageio/ implements this interface; it is built as libdustbench_pictures.so next
// to the kit.
// Units: pixels, rows from the top. Errors: returned as text, empty on success. Threads: any; calls are independent.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "methods/kit/files/limits.h"
#include "methods/kit/maths/srgb.h"

namespace dustbench::pictures {

/// How an image file encodes its colours, and the conversion to linear light.
struct ColourEncoding {
    enum class Kind { linear, srgb, power, unknown } kind = Kind::srgb;
    float exponent = 1;  ///< of `power`: linear = encoded^exponent
    std::string name{};  ///< of `unknown`: its name in the file

    /// For an exponent from a file: linear = encoded^exponent. Within 5 % of 2.2 it counts as sRGB, which writers of
    /// PNG approximate by this power; libpng does the same.
    [[nodiscard]] static ColourEncoding ofPower(float exponent) {
        if (std::abs(exponent / 2.2f - 1) < 0.05f) return {Kind::srgb};
        return {Kind::power, exponent};
    }

    /// Decodes one channel; returns values of an unknown encoding unchanged.
    [[nodiscard]] float decoded(float value) const {
        if (kind == Kind::srgb) return maths::decodeSrgb(value);
        return kind == Kind::power ? std::pow(std::max(value, 0.0f), exponent) : value;
    }
    /// Empty if the colours can be decoded; otherwise the reason.
    [[nodiscard]] std::string refusal() const {
        if (kind != Kind::unknown) return "";
        return "its colours are encoded as '" + name + "', expected sRGB, Rec709, linear or a gamma";
    }
};

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

/// Rejects pictures that are too large, by their headers: empty if the pixels, as floats, are within the limits;
/// otherwise the reason.
[[nodiscard]] inline std::string tooLarge(std::int64_t width, std::int64_t height, std::int64_t channels) {
    namespace limits = files::limits;
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (width > limits::imageEdge || height > limits::imageEdge)
        return "it has " + size + ", allowed: " + std::to_string(limits::imageEdge) + " per side (limit of images)";
    const auto bytes = static_cast<std::uintmax_t>(width * height * channels) * sizeof(float);
    if (bytes > limits::imageBytes)
        return "it has " + size + " of " + std::to_string(channels) +
               " channels, allowed: 1 GB decoded (limit of images)";
    return "";
}

}  // namespace dustbench::pictures
