// Implements the picture library with OpenImageIO; the only file that includes it.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string_view>

#include "methods/kit/pictures/picture_library.h"
#include "methods/kit/pictures/picture_limits.h"

namespace dustbench::pictures {
namespace {

constexpr int oneThread = 1;

/// OpenImageIO's message as one line.
std::string oneLine(std::string message) {
    while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back())) != 0) message.pop_back();
    std::replace(message.begin(), message.end(), '\n', ' ');
    return message.empty() ? "no reason given" : message;
}

/// The channel that is alpha; -1: none. Of a GIF OpenImageIO 2.4 names the channel after the last one.
int alphaChannelOf(const OIIO::ImageSpec& spec) {
    if (spec.alpha_channel >= 0 && spec.alpha_channel < spec.nchannels) return spec.alpha_channel;
    for (int channel = 0; channel < std::min(spec.nchannels, static_cast<int>(spec.channelnames.size())); ++channel)
        if (spec.channelnames[static_cast<std::size_t>(channel)] == "A") return channel;
    return -1;
}

/// What the file says of its colours; if nothing, integers are encoded and floats are linear.
ColourEncoding encodingOf(const OIIO::ImageSpec& spec, std::string_view format) {
    using Kind = ColourEncoding::Kind;
    const std::string space = spec.get_string_attribute("oiio:ColorSpace");
    // Of PNM the library says Rec709 whatever the file is, as also of the floats of a .pfm.
    if (space.empty() || format == "pnm") return {spec.format.is_floating_point() ? Kind::linear : Kind::srgb};
    const auto isOne = [&](std::initializer_list<const char*> names) {
        return std::ranges::any_of(names, [&](const char* name) { return OIIO::Strutil::iequals(space, name); });
    };
    if (isOne({"linear", "scene_linear", "lin_srgb"})) return {Kind::linear};
    if (isOne({"sRGB", "Rec709"})) return {Kind::srgb};
    const float exponent = spec.get_float_attribute("oiio:Gamma");
    if (exponent > 0 && OIIO::Strutil::istarts_with(space, "gamma")) return ColourEncoding::ofPower(exponent);
    return {Kind::unknown, 1, space};
}

class OpenImageIo final : public PictureLibrary {
 public:
#ifdef __SANITIZE_THREAD__
    OpenImageIo() {
        // ThreadSanitizer cannot see into an uninstrumented OpenImageIO and reports false races in its thread pool.
        OIIO::attribute("threads", oneThread);
        OIIO::attribute("exr_threads", oneThread);
    }
#endif

    std::string read(const std::filesystem::path& file, StoredPicture& picture) const override {
        // Request straight alpha, because OpenImageIO would premultiply the encoded colours.
        OIIO::ImageSpec wanted;
        wanted.attribute("oiio:UnassociatedAlpha", 1);
        const auto input = OIIO::ImageInput::open(file.string(), &wanted);
        if (!input) return oneLine(OIIO::geterror());
        const OIIO::ImageSpec& spec = input->spec();
        const int channels = spec.nchannels;
        if (channels < 1 || spec.width < 1 || spec.height < 1 || spec.depth > 1) return "it is not a flat picture";
        if (std::string reason = tooLarge(spec.width, spec.height, channels); !reason.empty()) return reason;
        const bool integers = !spec.format.is_floating_point();
        picture = {spec.width,
                   spec.height,
                   channels,
                   alphaChannelOf(spec),
                   encodingOf(spec, input->format_name()),
                   !integers && spec.get_int_attribute("oiio:UnassociatedAlpha") == 0,
                   std::vector<float>(spec.image_pixels() * static_cast<std::size_t>(channels))};
        if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, picture.values.data()))
            return oneLine(input->geterror());
        return "";
    }

    std::string readSize(const std::filesystem::path& file, StoredPicture& picture) const override {
        const auto input = OIIO::ImageInput::open(file.string());
        if (!input) return oneLine(OIIO::geterror());
        picture.width = input->spec().width;
        picture.height = input->spec().height;
        return "";
    }

    std::string encodeJpeg(int width, int height, std::span<const std::uint8_t> rgb, int quality,
                           std::vector<std::uint8_t>& jpeg) const override {
        OIIO::Filesystem::IOVecOutput sink(jpeg);
        const auto output = OIIO::ImageOutput::create("jpeg", &sink);
        if (!output) return oneLine(OIIO::geterror());
        OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
        spec.attribute("Compression", "jpeg:" + std::to_string(quality));
        if (!output->open("jpeg", spec) || !output->write_image(spec.format, rgb.data()) || !output->close())
            return oneLine(output->geterror());
        return "";
    }

    std::string resize(std::span<const float> from, int fromWidth, int fromHeight, std::span<float> to, int width,
                       int height) const override {
        std::vector<float> source(from.begin(), from.end());  // OpenImageIO wraps memory that it may write to
        const OIIO::ImageBuf read(OIIO::ImageSpec(fromWidth, fromHeight, 4, OIIO::TypeDesc::FLOAT), source.data());
        OIIO::ImageBuf written(OIIO::ImageSpec(width, height, 4, OIIO::TypeDesc::FLOAT), to.data());
        const OIIO::ROI all(0, width, 0, height, 0, 1, 0, 4);
        return OIIO::ImageBufAlgo::resize(written, read, "blackman-harris", 0.0f, all, oneThread)
                   ? ""
                   : oneLine(written.geterror());
    }
};

}  // namespace
}  // namespace dustbench::pictures

extern "C" DUSTBENCH_API const dustbench::pictures::PictureLibrary* dustbenchPictureLibrary();
extern "C" const dustbench::pictures::PictureLibrary* dustbenchPictureLibrary() {
    static const dustbench::pictures::OpenImageIo library;
    return &library;
}
