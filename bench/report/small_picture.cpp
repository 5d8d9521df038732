#include "bench/report/small_picture.h"

#include <cmath>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/pictures/picture_files.h"
#include "methods/kit/pictures/picture_library.h"

namespace dustbench::bench {
namespace {

/// Compression artefacts are invisible; metrics use the EXR files.
constexpr int jpegQuality = 80;

/// Red, green and blue of each pixel, as in the file.
std::vector<std::uint8_t> colourBytes(const pictures::StoredPicture& picture) {
    const auto channels = static_cast<std::size_t>(picture.channels);
    std::vector<std::uint8_t> bytes;
    for (std::size_t pixel = 0; pixel < picture.values.size(); pixel += channels)
        for (std::size_t colour = 0; colour < 3; ++colour)
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * picture.values[pixel + colour])));
    return bytes;
}

}  // namespace

SmallPicture makeSmall(const std::filesystem::path& png) {
    const pictures::PictureLibrary& library = pictures::pictureLibrary();
    pictures::StoredPicture picture;
    std::string fault = pictures::readPicture(png, picture);
    if (fault.empty() && picture.channels < 3) fault = "it has no colours";
    if (!fault.empty()) throw InputError("'" + png.string() + "': cannot be read as a picture: " + fault);

    SmallPicture small{"image/png", files::wholeText(png, "a picture", files::limits::geometryBytes), picture.width,
                       picture.height};
    std::vector<std::uint8_t> jpeg;
    // If JPEG encoding fails, the original file is used.
    if (library.encodeJpeg(picture.width, picture.height, colourBytes(picture), jpegQuality, jpeg).empty() &&
        jpeg.size() < small.bytes.size()) {
        small.mediaType = "image/jpeg";
        small.bytes.assign(jpeg.begin(), jpeg.end());
    }
    return small;
}

}  // namespace dustbench::bench
