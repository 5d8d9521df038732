#include "methods/kit/pictures/image.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/pictures/picture_files.h"
#include "methods/kit/pictures/picture_library.h"

namespace dustbench::pictures {
namespace fs = std::filesystem;
namespace {

bool isOpaque(const Image& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [](const glm::vec4& p) { return p.a >= 1; });
}

std::uint8_t toByte(float share) {
    return static_cast<std::uint8_t>(std::lround(255 * share));
}

/// Straight alpha, encoded colours, rounded to the nearest of 256 steps.
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

/// Empty on success; otherwise the reason for the failure.
std::string tryToWrite(const Image& image, const fs::path& file, bool png) {
    if (!png) return writeExr(file, image.width, image.height, {&image.pixels[0].x, image.pixels.size() * 4});
    const bool withAlpha = !isOpaque(image);
    return writePng(file, image.width, image.height, withAlpha ? 4 : 3, encodedBytes(image, withAlpha));
}

/// A pixel's channels as RGBA, straight or premultiplied. The channels other than alpha are red, green and blue, or the
/// first of them is grey. Missing alpha is 1; alpha alone also serves as grey.
glm::vec4 toRgba(std::span<const float> channels, int alphaChannel) {
    const auto count = static_cast<int>(channels.size());
    const bool hasAlpha = alphaChannel >= 0 && alphaChannel < count;
    const bool isGrey = count - (hasAlpha ? 1 : 0) < 3;
    glm::vec4 pixel(1);
    for (int colour = 0; colour < 3; ++colour) {
        const int place = isGrey ? 0 : colour;
        const int channel = hasAlpha && count > 1 && place >= alphaChannel ? place + 1 : place;
        pixel[colour] = channels[static_cast<std::size_t>(channel)];
    }
    if (hasAlpha) pixel.a = channels[static_cast<std::size_t>(alphaChannel)];
    return pixel;
}

}  // namespace

Image over(const Image& layer, const Image& scene) {
    if (layer.width != scene.width || layer.height != scene.height)
        throw std::invalid_argument("over: the layer and the scene differ in size");
    Image result = layer;
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] += (1 - layer.pixels[i].a) * scene.pixels[i];
    return result;
}

Image decoded(Image image) {
    for (glm::vec4& pixel : image.pixels)
        pixel = {decodeSrgb(pixel.r), decodeSrgb(pixel.g), decodeSrgb(pixel.b), pixel.a};
    return image;
}

std::vector<std::string> unusedParts(const StoredPicture& picture, int colours, bool usesAlpha) {
    static constexpr std::array usual{"R", "G", "B"};
    std::vector<std::string> parts;
    int colour = 0;
    for (int channel = 0; channel < picture.channels; ++channel) {
        const bool isAlpha = channel == picture.alphaChannel;
        if (isAlpha ? usesAlpha : colour++ < colours) continue;
        const auto place = static_cast<std::size_t>(channel);
        parts.push_back(files::namedPart("channel", place < picture.channelNames.size() ? picture.channelNames[place]
                                                    : isAlpha                           ? "A"
                                                    : place < usual.size()              ? usual[place]
                                                                                        : std::to_string(channel + 1)));
    }
    parts.insert(parts.end(), picture.ignored.begin(), picture.ignored.end());
    return parts;
}

void writeImage(const Image& image, const fs::path& file) {
    const std::string extension = file.extension().string();
    if (extension != ".png" && extension != ".exr")
        throw InputError("image '" + file.string() + "' cannot be written: got extension '" + extension +
                         "', expected .png or .exr");
    if (image.width < 1 || image.height < 1)
        throw InputError("image '" + file.string() + "' cannot be written: it has no pixels");

    // A temporary file next to the target keeps the rename within one file system; the process id makes it unique.
    fs::path temporary = file;
    temporary += ".part" + std::to_string(getpid());
    const auto fail = [&](const std::string& reason, int error) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        if (files::isOfMachine(error)) files::failWriting(file, error);
        throw InputError("image '" + file.string() + "' cannot be written: " + reason);
    };
    errno = 0;
    if (const std::string reason = tryToWrite(image, temporary, extension == ".png"); !reason.empty())
        fail(reason, errno);
    std::error_code error;
    fs::rename(temporary, file, error);
    if (error) fail(error.message(), error.value());
}

std::string encodedPng(const Image& image) {
    std::string png;
    const bool withAlpha = !isOpaque(image);
    const std::string reason =
        encodePng(image.width, image.height, withAlpha ? 4 : 3, encodedBytes(image, withAlpha), png);
    if (!reason.empty()) throw InputError("an image cannot be encoded: " + reason);
    return png;
}

Image readImage(const fs::path& file) {
    StoredPicture stored;
    if (const std::string reason = readPicture(file, stored); !reason.empty())
        throw InputError("image '" + file.string() + "' cannot be read: " + reason);
    if (const std::string reason = stored.encoding.refusal(); !reason.empty())
        throw InputError("image '" + file.string() + "' cannot be read: " + reason);
    if (const std::string reason = tooLarge(stored.width, stored.height, 4); !reason.empty())
        throw InputError("image '" + file.string() + "' cannot be read: " + reason);
    const int hues = stored.channels - (stored.alphaChannel >= 0 ? 1 : 0);
    files::noteIgnored(file, unusedParts(stored, hues < 3 ? 1 : 3, true));
    const auto pixels = static_cast<std::size_t>(stored.width) * static_cast<std::size_t>(stored.height);
    const auto channels = static_cast<std::size_t>(stored.channels);
    Image image{stored.width, stored.height, std::vector<glm::vec4>(pixels)};
    for (std::size_t i = 0; i < pixels; ++i) {
        glm::vec4 pixel = toRgba({&stored.values[i * channels], channels}, stored.alphaChannel);
        for (int colour = 0; colour < 3; ++colour) pixel[colour] = stored.encoding.decoded(pixel[colour]);
        if (!stored.isPremultiplied) pixel = {glm::vec3(pixel) * pixel.a, pixel.a};
        image.pixels[i] = pixel;
    }
    return image;
}

}  // namespace dustbench::pictures
