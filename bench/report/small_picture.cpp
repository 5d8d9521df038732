#include "bench/report/small_picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <fstream>
#include <iterator>
#include <vector>

#include "methods/shared/errors.h"

namespace dustbench::bench {
namespace {

/// Of JPEG, out of 100. Traces of compression stay below what a screen shows; numbers come from the EXR files.
constexpr const char* jpegQuality = "jpeg:80";

InputError unreadable(const std::filesystem::path& file) {
    return InputError("'" + file.string() + "': cannot be read as a picture: " + OIIO::geterror());
}

}  // namespace

SmallPicture makeSmall(const std::filesystem::path& png) {
    const auto input = OIIO::ImageInput::open(png.string());
    if (!input) throw unreadable(png);
    const OIIO::ImageSpec from = input->spec();
    const auto pixels = static_cast<std::size_t>(from.width) * static_cast<std::size_t>(from.height);
    std::vector<unsigned char> values(pixels * 3);
    if (from.nchannels < 3 || !input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, values.data()))
        throw unreadable(png);

    std::ifstream stream(png, std::ios::binary);
    SmallPicture small{"image/png", {std::istreambuf_iterator<char>(stream), {}}, from.width, from.height};
    std::vector<unsigned char> jpeg;
    OIIO::Filesystem::IOVecOutput sink(jpeg);
    const auto output = OIIO::ImageOutput::create("picture.jpg", &sink);
    OIIO::ImageSpec to(from.width, from.height, 3, OIIO::TypeDesc::UINT8);
    to.attribute("Compression", jpegQuality);
    // A build without JPEG still has the file itself.
    if (output && output->open("picture.jpg", to) && output->write_image(OIIO::TypeDesc::UINT8, values.data()) &&
        output->close() && jpeg.size() < small.bytes.size()) {
        small.mediaType = "image/jpeg";
        small.bytes.assign(jpeg.begin(), jpeg.end());
    }
    return small;
}

}  // namespace dustbench::bench
