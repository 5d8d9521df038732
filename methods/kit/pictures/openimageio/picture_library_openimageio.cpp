// Implements the picture library with OpenImageIO; the only file that includes it.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string_view>
#include <utility>

#include "methods/kit/pictures/picture_library.h"

namespace dustbench::pictures {
namespace {

constexpr int oneThread = 1;

/// OpenImageIO's message as one line.
std::string oneLine(std::string message) {
    while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back())) != 0) message.pop_back();
    std::replace(message.begin(), message.end(), '\n', ' ');
    return message.empty() ? "no reason given" : message;
}

/// The index of the alpha channel; -1: none. For a GIF, OpenImageIO 2.4 returns the index after the last channel.
int alphaChannelOf(const OIIO::ImageSpec& spec) {
    if (spec.alpha_channel >= 0 && spec.alpha_channel < spec.nchannels) return spec.alpha_channel;
    for (int channel = 0; channel < std::min(spec.nchannels, static_cast<int>(spec.channelnames.size())); ++channel)
        if (spec.channelnames[static_cast<std::size_t>(channel)] == "A") return channel;
    return -1;
}

/// Names a colour profile other than sRGB, or primaries other than sRGB's; empty if there are none.
std::string otherColours(const OIIO::ImageSpec& spec) {
    if (spec.find_attribute("ICCProfile")) {
        const std::string name = spec.get_string_attribute("ICCProfile:profile_description");
        if (!OIIO::Strutil::icontains(name, "sRGB")) return name.empty() ? "an ICC profile" : name.substr(0, 60);
    }
    constexpr std::array<float, 8> ofSrgb{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
    const auto* const primaries = spec.find_attribute("chromaticities");
    if (primaries && primaries->type().basetype == OIIO::TypeDesc::FLOAT &&
        static_cast<std::size_t>(primaries->datasize()) == sizeof ofSrgb)
        for (std::size_t i = 0; i < ofSrgb.size(); ++i)
            if (!(std::abs(static_cast<const float*>(primaries->data())[i] - ofSrgb[i]) < 0.01f))
                return "other primaries (chromaticities)";
    return "";
}

/// The encoding stated in the file; by default integers are sRGB-encoded and floats are linear.
ColourEncoding encodingOf(const OIIO::ImageSpec& spec, std::string_view format) {
    using Kind = ColourEncoding::Kind;
    if (std::string other = otherColours(spec); !other.empty()) return {Kind::unknown, 1, std::move(other)};
    const std::string space = spec.get_string_attribute("oiio:ColorSpace");
    // For PNM the library always reports Rec709, even for the floats of a .pfm.
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

/// The pixels that a file displays, which may be more or fewer than it stores.
struct Window {
    int x = 0, y = 0, width = 0, height = 0;
};

/// The display window of an EXR, and of any other file whose display window has a different size than its pixels. In a
/// PNG or TIFF, an offset alone is a position on a page.
Window shownBy(const OIIO::ImageSpec& spec, std::string_view format) {
    const bool isWindow = format == "openexr" || spec.full_width != spec.width || spec.full_height != spec.height;
    if (isWindow && spec.full_width > 0 && spec.full_height > 0)
        return {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
    return {spec.x, spec.y, spec.width, spec.height};
}

/// The pixels inside the window; the rest is black, and transparent if there is alpha.
std::vector<float> filled(const Window& window, const OIIO::ImageSpec& spec, const std::vector<float>& pixels) {
    const auto channels = static_cast<std::ptrdiff_t>(spec.nchannels);
    std::vector<float> values(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height) *
                              static_cast<std::size_t>(spec.nchannels));
    const int left = std::max(window.x, spec.x), right = std::min(window.x + window.width, spec.x + spec.width);
    for (int y = std::max(window.y, spec.y); y < std::min(window.y + window.height, spec.y + spec.height); ++y) {
        if (left >= right) break;
        const auto from = (std::ptrdiff_t{y - spec.y} * spec.width + (left - spec.x)) * channels;
        const auto to = (std::ptrdiff_t{y - window.y} * window.width + (left - window.x)) * channels;
        std::copy_n(pixels.begin() + from, (right - left) * channels, values.begin() + to);
    }
    return values;
}

/// Empty if the file has one picture; otherwise a reason with the names of its parts. A .psd stores the merged picture
/// before its layers.
std::string severalParts(const std::filesystem::path& file) {
    constexpr int mostNames = 10;
    const auto input = OIIO::ImageInput::open(file.string());  // opened separately: a GIF loses its position
    if (!input || std::string_view(input->format_name()) == "psd" || !input->seek_subimage(1, 0)) return "";
    std::string names;
    for (int part = 0; part < mostNames && input->seek_subimage(part, 0); ++part)
        if (const std::string name = input->spec().get_string_attribute("oiio:subimagename"); !name.empty())
            names += (names.empty() ? ": " : ", ") + name;
    return "it has several parts, expected one" + names;
}

/// True for a `.psd` with layers after the merged picture.
bool hasMore(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    return input && input->seek_subimage(1, 0);
}

/// Empty unless the channels are not colours or belong to several layers; then a reason with their names.
std::string severalLayers(const OIIO::ImageSpec& spec) {
    if (std::ranges::find(spec.channelnames, "RY") != spec.channelnames.end())
        return "its channels are luminance and chroma (Y, RY, BY), expected red, green and blue";
    std::set<std::string> layers;
    for (const std::string& channel : spec.channelnames) {
        const std::size_t end = channel.rfind('.');
        if (end == std::string::npos) return "";
        layers.insert(channel.substr(0, end));
    }
    if (layers.size() < 2) return "";
    std::string names;
    for (const std::string& layer : layers) names += (names.empty() ? "" : ", ") + layer;
    return "it has several layers, expected one or channels without a layer: " + names;
}

class OpenImageIo final : public PictureLibrary {
 public:
#ifdef DUSTBENCH_PORTABLE
    // The portable file has only stubs of some libraries (.ci/portable-stubs): a file is read by the reader of its
    // extension alone, or the stubs would be called for every file that no reader recognises.
    OpenImageIo() {
        OIIO::attribute("try_all_readers", 0);
    }
#endif
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
        if (std::string reason = severalParts(file); !reason.empty()) return reason;
        const OIIO::ImageSpec& spec = input->spec();
        const int channels = spec.nchannels;
        if (channels < 1 || spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.deep)
            return "it is not a 2D picture";
        const Window window = shownBy(spec, input->format_name());
        for (const auto& [width, height] : {std::pair(spec.width, spec.height), std::pair(window.width, window.height)})
            if (std::string reason = tooLarge(width, height, channels); !reason.empty()) return reason;
        if (std::string reason = severalLayers(spec); !reason.empty()) return reason;
        const bool integers = !spec.format.is_floating_point();
        picture = {window.width,
                   window.height,
                   channels,
                   alphaChannelOf(spec),
                   encodingOf(spec, input->format_name()),
                   !integers && spec.get_int_attribute("oiio:UnassociatedAlpha") == 0,
                   std::vector<float>(spec.image_pixels() * static_cast<std::size_t>(channels)),
                   spec.channelnames,
                   {}};
        if (std::string_view(input->format_name()) == "psd" && hasMore(file)) picture.ignored.emplace_back("layers");
        if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, picture.values.data()))
            return oneLine(input->geterror());
        if (window.x != spec.x || window.y != spec.y || window.width != spec.width || window.height != spec.height)
            picture.values = filled(window, spec, picture.values);
        return "";
    }

    std::string readSize(const std::filesystem::path& file, StoredPicture& picture) const override {
        const auto input = OIIO::ImageInput::open(file.string());
        if (!input) return oneLine(OIIO::geterror());
        const Window window = shownBy(input->spec(), input->format_name());
        picture.width = window.width;
        picture.height = window.height;
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
        std::vector<float> source(from.begin(), from.end());  // OpenImageIO only wraps mutable memory
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
