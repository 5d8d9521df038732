// Image files by OpenImageIO: the one file that includes it.
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>

#include "methods/shared/draw/image.h"
#include "methods/shared/errors.h"

namespace dustbench::draw {
namespace {

namespace fs = std::filesystem;

/// OpenImageIO's message on one line.
std::string oneLine(std::string message) {
    while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back()))) message.pop_back();
    std::replace(message.begin(), message.end(), '\n', ' ');
    return message.empty() ? "no reason given" : message;
}

bool isOpaque(const Image& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [](const glm::vec4& p) { return p.a >= 1; });
}

std::uint8_t toByte(float share) {
    return static_cast<std::uint8_t>(std::lround(255 * share));
}

/// Straight alpha, colours encoded, to the nearest of 256 steps.
std::vector<std::uint8_t> encodedBytes(const Image& image, bool withAlpha) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixels.size() * (withAlpha ? 4 : 3));
    for (const glm::vec4& pixel : image.pixels) {
        const float alpha = pixel.a > 0 ? std::min(pixel.a, 1.0f) : 0.0f;
        const float share = withAlpha && alpha > 0 ? alpha : 1.0f;
        for (int channel = 0; channel < 3; ++channel) bytes.push_back(toByte(encodeSrgb(pixel[channel] / share)));
        if (withAlpha) bytes.push_back(toByte(alpha));
    }
    return bytes;
}

/// Empty on success, else what went wrong. `type` names the format, whatever the file is called.
std::string tryToWrite(const Image& image, const fs::path& file, const std::string& type) {
    const bool png = type == "png";
    const bool withAlpha = !png || !isOpaque(image);
    OIIO::ImageSpec spec(image.width, image.height, withAlpha ? 4 : 3,
                         png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
    if (png) {
        spec.attribute("oiio:ColorSpace", "sRGB");
        spec.attribute("oiio:UnassociatedAlpha", 1);
    } else {
        spec.attribute("oiio:ColorSpace", "Linear");
        spec.attribute("compression", "zip");
    }
    const auto output = OIIO::ImageOutput::create(type);
    if (!output) return oneLine(OIIO::geterror());
    if (!output->open(file.string(), spec)) return oneLine(output->geterror());
    const bool written = png ? output->write_image(OIIO::TypeDesc::UINT8, encodedBytes(image, withAlpha).data())
                             : output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data());
    if (!written || !output->close()) return oneLine(output->geterror());
    return "";
}

/// The file's channels as straight or premultiplied RGBA: grey is spread over the colours, missing alpha is 1.
glm::vec4 toRgba(const float* channels, int count, int alphaChannel) {
    glm::vec4 pixel(channels[0], channels[0], channels[0], 1);
    const int colours = alphaChannel >= 0 ? count - 1 : count;
    if (colours >= 3) pixel = {channels[0], channels[1], channels[2], 1};
    if (alphaChannel >= 0) pixel.a = channels[alphaChannel];
    return pixel;
}

}  // namespace

void writeImage(const Image& image, const fs::path& file) {
    const std::string extension = file.extension().string();
    if (extension != ".png" && extension != ".exr")
        throw InputError("cannot write image '" + file.string() + "': got extension '" + extension +
                         "', expected .png or .exr");
    if (image.width < 1 || image.height < 1)
        throw InputError("cannot write image '" + file.string() + "': it has no pixels");

    // Beside the target, so that the rename stays within one file system; the process makes the name its own.
    fs::path beside = file;
    beside += ".part" + std::to_string(getpid());
    const auto fail = [&](const std::string& reason) {
        std::error_code ignored;
        fs::remove(beside, ignored);
        throw InputError("cannot write image '" + file.string() + "': " + reason);
    };
    if (const std::string reason = tryToWrite(image, beside, extension.substr(1)); !reason.empty()) fail(reason);
    std::error_code error;
    fs::rename(beside, file, error);
    if (error) fail(error.message());
}

Image readImage(const fs::path& file) {
    // Straight alpha is asked for: OpenImageIO would premultiply the encoded colours.
    OIIO::ImageSpec wanted;
    wanted.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(file.string(), &wanted);
    if (!input) throw InputError("cannot read image '" + file.string() + "': " + oneLine(OIIO::geterror()));
    const OIIO::ImageSpec& spec = input->spec();
    const int count = spec.nchannels;
    if (count < 1 || spec.width < 1 || spec.height < 1 || spec.depth > 1)
        throw InputError("cannot read image '" + file.string() + "': it is not a flat picture");

    std::vector<float> values(spec.image_pixels() * static_cast<std::size_t>(count));
    if (!input->read_image(0, 0, 0, count, OIIO::TypeDesc::FLOAT, values.data()))
        throw InputError("cannot read image '" + file.string() + "': " + oneLine(input->geterror()));

    const std::string space = spec.get_string_attribute("oiio:ColorSpace");
    const bool integers = !spec.format.is_floating_point();
    const bool encoded = space.empty() ? integers : OIIO::Strutil::iequals(space, "sRGB");
    const bool straight = integers || spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
    Image image{spec.width, spec.height, std::vector<glm::vec4>(spec.image_pixels())};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        glm::vec4 pixel = toRgba(&values[i * static_cast<std::size_t>(count)], count, spec.alpha_channel);
        if (encoded) pixel = {decodeSrgb(pixel.r), decodeSrgb(pixel.g), decodeSrgb(pixel.b), pixel.a};
        if (straight) pixel = {glm::vec3(pixel) * pixel.a, pixel.a};
        image.pixels[i] = pixel;
    }
    return image;
}

}  // namespace dustbench::draw
