// PNG files through libpng: 8-bit files are read here, others by OpenImageIO.
#include <png.h>

#include "methods/kit/pictures/picture_files.h"

namespace dustbench::pictures {
namespace {

/// RAII wrapper of libpng's picture description.
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

}  // namespace

std::string readPicture(const std::filesystem::path& file, StoredPicture& picture) {
    PngImage image;
    // OpenImageIO handles everything but plain 8-bit PNG, and reports what is wrong with invalid files.
    if (png_image_begin_read_from_file(image.get(), file.c_str()) == 0 ||
        (image->format & (PNG_FORMAT_FLAG_LINEAR | PNG_FORMAT_FLAG_COLORMAP)) != 0 || image->warning_or_error != 0)
        return pictureLibrary().read(file, picture);
    const int channels = static_cast<int>(PNG_IMAGE_SAMPLE_CHANNELS(image->format));
    std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(*image.get()));
    if (png_image_finish_read(image.get(), nullptr, bytes.data(), 0, nullptr) == 0) return image.message();
    const bool hasAlpha = (image->format & PNG_FORMAT_FLAG_ALPHA) != 0;
    picture = {static_cast<int>(image->width),
               static_cast<int>(image->height),
               channels,
               hasAlpha ? channels - 1 : -1,
               true,
               false,
               std::vector<float>(bytes.begin(), bytes.end())};
    for (float& value : picture.values) value *= 1.0f / 255;
    return "";
}

std::string readPictureSize(const std::filesystem::path& file, StoredPicture& picture) {
    PngImage image;
    if (png_image_begin_read_from_file(image.get(), file.c_str()) == 0) return pictureLibrary().readSize(file, picture);
    picture.width = static_cast<int>(image->width);
    picture.height = static_cast<int>(image->height);
    return "";
}

std::string writePng(const std::filesystem::path& file, int width, int height, int channels,
                     std::span<const std::uint8_t> bytes) {
    PngImage image;
    image->width = static_cast<png_uint_32>(width);
    image->height = static_cast<png_uint_32>(height);
    image->format = channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    return png_image_write_to_file(image.get(), file.c_str(), 0, bytes.data(), 0, nullptr) != 0 ? "" : image.message();
}

}  // namespace dustbench::pictures
