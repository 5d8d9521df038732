// PNG files, through libpng: 8-bit files are read here, others by OpenImageIO.
#include <png.h>

#include <array>
#include <fstream>
#include <string_view>

#include "methods/kit/files/whole_text.h"
#include "methods/kit/pictures/picture_files.h"
#include "methods/kit/pictures/picture_library.h"

namespace dustbench::pictures {
namespace {

/// RAII wrapper of libpng's image structure.
class PngImage {
 public:
    PngImage() { image_.version = PNG_IMAGE_VERSION; }
    ~PngImage() { png_image_free(&image_); }
    PngImage(const PngImage&) = delete;
    PngImage& operator=(const PngImage&) = delete;
    png_image* operator->() { return &image_; }
    png_image* get() { return &image_; }
    [[nodiscard]] std::string message() const { return image_.message; }

 private:
    png_image image_{};
};

bool isPng(const std::filesystem::path& file) {
    std::array<png_byte, 8> start{};
    std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(start.data()), start.size());
    return png_sig_cmp(start.data(), 0, start.size()) == 0;
}

/// True if the file has a gamma, which libpng's simple reader would apply, or a colour profile, which it would
/// ignore.
bool saysColours(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(8);
    for (std::array<char, 8> head{}; stream.read(head.data(), head.size());) {
        const std::string_view type(head.data() + 4, 4);
        if (type == "gAMA" || type == "iCCP" || type == "IDAT") return type != "IDAT";
        const png_uint_32 bytes = png_get_uint_32(reinterpret_cast<const png_byte*>(head.data()));
        if (bytes > PNG_UINT_31_MAX) return false;
        stream.seekg(std::streamoff{bytes} + 4, std::ios::cur);  // and its checksum
    }
    return false;
}

/// PNG packs at most 1,032 bytes into one, and eight pixels into a byte, so a short file cannot hold a large picture.
bool isTooShort(const std::filesystem::path& file, const png_image& image) {
    std::error_code none;
    constexpr std::uintmax_t pixelsPerByte = 8 * 1032;
    return std::filesystem::file_size(file, none) < std::uintmax_t{image.width} * image.height / pixelsPerByte;
}

}  // namespace

std::string readPicture(const std::filesystem::path& file, StoredPicture& picture) {
    if (std::string reason = files::refusalOf(file, files::limits::geometryBytes); !reason.empty()) return reason;
    PngImage image;
    // OpenImageIO handles everything but plain 8-bit PNG in sRGB. With a damaged PNG it lets libpng write to standard
    // error.
    const bool begun = png_image_begin_read_from_file(image.get(), file.c_str()) != 0;
    if (!begun && isPng(file)) return image.message();
    if (!begun || (image->format & (PNG_FORMAT_FLAG_LINEAR | PNG_FORMAT_FLAG_COLORMAP)) != 0 ||
        image->warning_or_error != 0 || saysColours(file))
        return pictureLibrary().read(file, picture);
    const int channels = static_cast<int>(PNG_IMAGE_SAMPLE_CHANNELS(image->format));
    if (std::string reason = tooLarge(image->width, image->height, channels); !reason.empty()) return reason;
    if (isTooShort(file, *image.get())) return "it is truncated, or its header states too many pixels";
    std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(*image.get()));
    if (png_image_finish_read(image.get(), nullptr, bytes.data(), 0, nullptr) == 0) return image.message();
    const bool hasAlpha = (image->format & PNG_FORMAT_FLAG_ALPHA) != 0;
    picture = {static_cast<int>(image->width),
               static_cast<int>(image->height),
               channels,
               hasAlpha ? channels - 1 : -1,
               ColourEncoding(),
               false,
               std::vector<float>(bytes.begin(), bytes.end()),
               {},
               {}};
    for (float& value : picture.values) value *= 1.0f / 255;
    return "";
}

std::string readPictureSize(const std::filesystem::path& file, StoredPicture& picture) {
    if (std::string reason = files::refusalOf(file, files::limits::geometryBytes); !reason.empty()) return reason;
    PngImage image;
    if (png_image_begin_read_from_file(image.get(), file.c_str()) == 0)
        return isPng(file) ? image.message() : pictureLibrary().readSize(file, picture);
    picture.width = static_cast<int>(image->width);
    picture.height = static_cast<int>(image->height);
    return "";
}

namespace {

void describe(PngImage& image, int width, int height, int channels) {
    image->width = static_cast<png_uint_32>(width);
    image->height = static_cast<png_uint_32>(height);
    image->format = channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
}

}  // namespace

std::string writePng(const std::filesystem::path& file, int width, int height, int channels,
                     std::span<const std::uint8_t> bytes) {
    PngImage image;
    describe(image, width, height, channels);
    return png_image_write_to_file(image.get(), file.c_str(), 0, bytes.data(), 0, nullptr) != 0 ? "" : image.message();
}

std::string encodePng(int width, int height, int channels, std::span<const std::uint8_t> bytes, std::string& png) {
    PngImage image;
    describe(image, width, height, channels);
    png_alloc_size_t size = 0;  // queried first, which encodes the picture twice
    if (png_image_write_to_memory(image.get(), nullptr, &size, 0, bytes.data(), 0, nullptr) == 0)
        return image.message();
    png.resize(size);
    describe(image, width, height, channels);
    return png_image_write_to_memory(image.get(), png.data(), &size, 0, bytes.data(), 0, nullptr) != 0
               ? ""
               : image.message();
}

}  // namespace dustbench::pictures
