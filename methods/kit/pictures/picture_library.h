// What dustbench asks of OpenImageIO, behind a library that is loaded at first use.
//
// OpenImageIO brings some 250 libraries with it, and linking them took most of every start; what runs read
// and write goes without it (picture_files.h). openimageio/ is the other side, built as libdustbench_pictures.so beside
// the program.
// Units: pixels, rows from the top. Errors: text that is empty on success. Threads: any; each call by itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace dustbench::pictures {

/// A flat picture as its file has it, values as floats (0..1 for files of integers).
struct StoredPicture {
    int width = 0, height = 0, channels = 0;
    int alphaChannel = -1;         ///< or none
    bool isEncoded = false;        ///< colours are sRGB encoded, else linear
    bool isPremultiplied = false;  ///< by alpha
    std::vector<float> values;     ///< pixel by pixel
};

/// What a line's ink lies within, seen from the pen's start on the baseline; y runs down.
struct InkBox {
    int left = 0, right = 0, top = 0, bottom = 0;

    [[nodiscard]] int width() const { return right - left; }
    [[nodiscard]] int height() const { return bottom - top; }
};

class PictureLibrary {
 public:
    virtual ~PictureLibrary() = default;

    [[nodiscard]] virtual std::string read(const std::filesystem::path& file, StoredPicture& picture) const = 0;
    /// RGB, sRGB; quality of 100 at most. The file's bytes, not a file.
    [[nodiscard]] virtual std::string encodeJpeg(int width, int height, std::span<const std::uint8_t> rgb, int quality,
                                                 std::vector<std::uint8_t>& jpeg) const = 0;

    /// False where there is no such font. Text without ink has an empty box.
    [[nodiscard]] virtual bool findInk(const std::string& line, int pixels, const std::string& font,
                                       InkBox& ink) const = 0;
    /// Share of each pixel of `ink` that the line covers.
    [[nodiscard]] virtual std::string drawText(const std::string& line, int pixels, const std::string& font,
                                               const InkBox& ink, std::span<float> coverage) const = 0;
    /// RGBA, filtered by a Blackman-Harris window.
    [[nodiscard]] virtual std::string resize(std::span<const float> from, int fromWidth, int fromHeight,
                                             std::span<float> to, int width, int height) const = 0;
};

/// Loads it at the first call. Throws std::runtime_error where the library is not beside the program.
[[nodiscard]] DUSTBENCH_API const PictureLibrary& pictureLibrary();

}  // namespace dustbench::pictures
