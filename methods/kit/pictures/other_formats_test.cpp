// Tests that pictures written by OpenImageIO's own command are read with the colours that they display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "methods/kit/pictures/image.h"
#include "methods/kit/pictures/picture_files.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::pictures {
namespace {

/// Whether `oiiotool` can write such files here. HEIF needs an encoder that Debian 12 installs with OpenImageIO, and
/// Debian 13 does not.
bool canWrite(const TestFolder& folder, const std::string& name) {
    if (!name.ends_with(".heic")) return true;
    const std::string file = (folder.path() / ("try_" + name)).string();
    if (std::system(("oiiotool --pattern black 32x32 3 -o '" + file + "' > /dev/null 2>&1").c_str()) == 0) return true;
    std::cout << "[ NOT RUN  ] " << name << ": oiiotool has no encoder for it (Debian 13: libheif-plugin-x265)\n";
    return false;
}

/// The file that `oiiotool` makes with these arguments.
std::filesystem::path made(const TestFolder& folder, const std::string& name, const std::string& arguments) {
    std::filesystem::path file = folder.path() / name;
    const std::string command = "oiiotool " + arguments + " -o '" + file.string() + "' > /dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return file;
}

void expectEverywhere(const Image& image, const glm::vec4& colour, float within, const std::string& what) {
    ASSERT_FALSE(image.pixels.empty()) << what;
    for (const glm::vec4& pixel : image.pixels)
        for (int channel = 0; channel < 4; ++channel)
            ASSERT_NEAR(pixel[channel], colour[channel], within) << what << ", channel " << channel;
}

TEST(OtherFormats, AlphaIsTheOneOfTheFileWhereverItsChannelIs) {
    const TestFolder folder;
    const auto expectRead = [&](const char* name, const char* arguments, const glm::vec4& colour) {
        expectEverywhere(readImage(made(folder, name, arguments)), colour, 2e-3f, name);
    };
    expectRead("opaque.gif", "--pattern constant:color=0,1,1 5x3 3 -d uint8", {0, 1, 1, 1});
    expectRead("rgba.exr", "--pattern constant:color=0.5,0.25,0.125,0.5 5x3 4 -d float", {0.5f, 0.25f, 0.125f, 0.5f});
    expectRead("grey_alpha.exr", "--pattern constant:color=0.25,0.5 5x3 2 --chnames Y,A -d float",
               {0.25f, 0.25f, 0.25f, 0.5f});
    expectRead("rgba.tif", "--pattern constant:color=0.25,0.5,0.125,1 5x3 4 -d float", {0.25f, 0.5f, 0.125f, 1});
}

struct Written {
    const char *name, *depth;
    bool isLinear = false;
    float within = 0.001f;  ///< of the stored values, 0..1
};

void PrintTo(const Written& written, std::ostream* stream) {
    *stream << written.name << ' ' << written.depth;
}

/// Every format in which OpenImageIO writes colours: the same values mean encoded colours in integers and linear ones
/// in floats.
TEST(OtherFormats, IntegersAreEncodedAndFloatsLinear) {
    constexpr float eight = 0.5f / 255, lossy = 0.02f;
    const TestFolder folder;
    for (const Written& written : std::vector<Written>{{"a.bmp", "uint8", false, eight},
                                                       {"a.dpx", "uint8", false, eight},
                                                       {"b.dpx", "uint10"},
                                                       {"c.dpx", "uint16"},
                                                       {"a.fits", "uint8", false, eight},
                                                       {"b.fits", "uint16"},
                                                       {"c.fits", "float", true},
                                                       {"a.gif", "uint8", false, lossy},
                                                       {"a.hdr", "float", true, 0.005f},
                                                       {"a.heic", "uint8", false, lossy},
                                                       {"a.ico", "uint8", false, 1.0f / 127},
                                                       {"a.iff", "uint8", false, eight},
                                                       {"b.iff", "uint16"},
                                                       {"a.jpg", "uint8", false, lossy},
                                                       {"a.exr", "half", true},
                                                       {"b.exr", "float", true},
                                                       {"a.png", "uint8", false, eight},
                                                       {"b.png", "uint16"},
                                                       {"a.ppm", "uint8", false, eight},
                                                       {"a.rla", "uint8", false, eight},
                                                       {"b.rla", "uint16"},
                                                       {"c.rla", "float", true},
                                                       {"a.sgi", "uint8", false, eight},
                                                       {"b.sgi", "uint16"},
                                                       {"a.tga", "uint8", false, eight},
                                                       {"a.tif", "uint8", false, eight},
                                                       {"b.tif", "uint16"},
                                                       {"c.tif", "half", true},
                                                       {"d.tif", "float", true},
                                                       {"a.webp", "uint8", false, lossy}}) {
        if (!canWrite(folder, written.name)) continue;
        const Image image = readImage(made(
            folder, written.name, std::string("--pattern constant:color=0.6,0.3,0.15 32x32 3 -d ") + written.depth));
        ASSERT_EQ(image.width, 32) << written.name;
        constexpr std::array<float, 3> stored{0.6f, 0.3f, 0.15f};
        for (const glm::vec4& pixel : image.pixels) {
            for (int channel = 0; channel < 3; ++channel)
                ASSERT_NEAR(written.isLinear ? pixel[channel] : encodeSrgb(pixel[channel]),
                            stored[static_cast<std::size_t>(channel)], written.within)
                    << testing::PrintToString(written) << ", channel " << channel;
            ASSERT_EQ(pixel.a, 1) << written.name;
        }
    }
}

/// OpenImageIO 2.4 writes wrong values to a .ppm of 16 bits, so these files are made here.
TEST(OtherFormats, PnmOf16BitsIsEncodedAndPfmLinear) {
    const TestFolder folder;
    std::string encoded = "P6\n8 8\n65535\n", grey = "P5\n8 8\n65535\n", linear = "PF\n8 8\n-1.0\n";
    for (int pixel = 0; pixel < 64; ++pixel) {
        encoded += "\x99\x99\x4c\xcd\x26\x66";
        grey += "\x99\x99";
        for (const float value : {0.6f, 0.3f, 0.15f})
            linear.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    expectEverywhere(readImage(folder.write("a.ppm", encoded)),
                     {decodeSrgb(0.6f), decodeSrgb(0.3f), decodeSrgb(0.15f), 1}, 1e-4f, "16-bit ppm");
    expectEverywhere(readImage(folder.write("a.pgm", grey)), glm::vec4(glm::vec3(decodeSrgb(0.6f)), 1), 1e-4f,
                     "16-bit pgm");
    expectEverywhere(readImage(folder.write("a.pfm", linear)), {0.6f, 0.3f, 0.15f, 1}, 1e-6f, "pfm");
}

/// A PNG file with a gAMA chunk of this many hundred thousandths after the header.
std::filesystem::path withGamma(const TestFolder& folder, const std::filesystem::path& png,
                                unsigned hundredThousandths) {
    std::ifstream stream(png, std::ios::binary);
    std::string bytes(std::istreambuf_iterator<char>(stream), {});
    const auto word = [](unsigned long value) {
        std::string text;
        for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xff);
        return text;
    };
    const std::string chunk = "gAMA" + word(hundredThousandths);
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size()));
    constexpr std::size_t afterHeader = 8 + 25;
    return folder.write("gamma.png", bytes.insert(afterHeader, word(4) + chunk + word(sum)));
}

TEST(OtherFormats, PngSaysByWhichPowerItIsEncoded) {
    const TestFolder folder;
    for (const char* depth : {"uint8", "uint16"}) {
        const auto png =
            made(folder, "a.png", std::string("--pattern constant:color=0.6,0.3,0.15 16x16 3 -d ") + depth);
        const auto expectDecoded = [&](unsigned gamma, const std::function<float(float)>& decode) {
            expectEverywhere(readImage(withGamma(folder, png, gamma)), {decode(0.6f), decode(0.3f), decode(0.15f), 1},
                             0.004f, std::string(depth) + ' ' + std::to_string(gamma));
        };
        expectDecoded(45455, decodeSrgb);
        expectDecoded(45000, decodeSrgb);
        expectDecoded(100000, [](float value) { return value; });
        expectDecoded(55556, [](float value) { return std::pow(value, 1.8f); });
    }
}

TEST(OtherFormats, PngIsTheSameWithAndWithoutTheUsualGamma) {
    const TestFolder folder;
    for (const char* depth : {"uint8", "uint16"}) {
        const auto png = made(folder, "a.png", std::string("--pattern fill:left=0,0,0:right=1,1,1 64x8 3 -d ") + depth);
        EXPECT_EQ(readImage(png).pixels, readImage(withGamma(folder, png, 45455)).pixels) << depth;
    }
}

TEST(OtherFormats, ColoursThatCannotBeDecodedAreRefusedAndTheirValuesRead) {
    const TestFolder folder;
    const auto file =
        made(folder, "log.dpx", "--pattern constant:color=0.5 16x16 3 -d uint10 --attrib oiio:ColorSpace KodakLog");
    EXPECT_THAT(inputError([&] { (void)readImage(file); }), testing::HasSubstr("encoded as 'KodakLog', expected sRGB"));
    StoredPicture stored;
    EXPECT_EQ(readPicture(file, stored), "");
    EXPECT_NEAR(stored.values.front(), 0.5f, 1e-3f);
}

TEST(OtherFormats, ExrFillsItsDisplayWindow) {
    const TestFolder folder;
    const auto expectFilled = [&](const char* arguments, int left, int top) {
        const Image image = readImage(made(folder, "a.exr", arguments));
        ASSERT_EQ(image.width, 12) << arguments;
        ASSERT_EQ(image.height, 10) << arguments;
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 12; ++x) {
                const bool isInside = x >= left && x < left + 4 && y >= top && y < top + 3;
                ASSERT_EQ(image.at(x, y), isInside ? glm::vec4(0.5f, 0.25f, 1, 1) : glm::vec4(0, 0, 0, 1))
                    << arguments << ": " << x << ' ' << y;
            }
    };
    const std::string pixels = "--pattern constant:color=0.5,0.25,1 4x3 3 -d float --fullsize 12x10+0+0 ";
    expectFilled((pixels + "--origin +0+0").c_str(), 0, 0);
    expectFilled((pixels + "--origin +7+6").c_str(), 7, 6);
    expectFilled((pixels + "--origin -2-1").c_str(), -2, -1);  // overscan is not shown
    expectFilled((pixels + "--origin +30+0").c_str(), 30, 0);  // nothing is shown
    expectFilled("--pattern constant:color=0.5,0.25,1 4x3 3 -d float --fullsize 12x10+100+50 --origin +101+52", 1, 2);
    StoredPicture size;
    EXPECT_EQ(readPictureSize(folder.path() / "a.exr", size), "");
    EXPECT_EQ(size.width, 12);
    // The position of a picture on a page, as scanners and GIMP write it, has no effect.
    EXPECT_EQ(readImage(made(folder, "b.png", "--pattern constant:color=1 4x3 3 --origin +2+1 -d uint16")).width, 4);
}

TEST(OtherFormats, SeveralPartsOrLayersAreRefusedAndNamed) {
    using testing::HasSubstr;
    const TestFolder folder;
    const auto refusal = [&](const char* name, const std::string& arguments) {
        return inputError([&] { (void)readImage(made(folder, name, arguments)); });
    };
    const std::string picture = "--pattern constant:color=0.5,0.25,1 16x16 3 ";
    EXPECT_THAT(refusal("a.exr", picture + "--attrib oiio:subimagename left " + picture +
                                     "--attrib oiio:subimagename right --siappend -d half"),
                HasSubstr("it has several parts, expected one: left, right"));
    EXPECT_THAT(refusal("a.tif", picture + picture + "--siappend -d uint8"), HasSubstr("it has several parts"));
    EXPECT_THAT(refusal("a.gif", picture + picture + "--siappend -d uint8"), HasSubstr("it has several parts"));
    EXPECT_THAT(refusal("b.exr", picture + "--chnames a.R,a.G,a.B " + picture + "--chnames b.R,b.G,b.B --chappend"),
                HasSubstr("it has several layers, expected one or channels without a layer: a, b"));
    const Image image = readImage(made(folder, "c.exr", picture + picture + "--chnames b.R,b.G,b.B --chappend"));
    expectEverywhere(image, {0.5f, 0.25f, 1, 1}, 1e-3f, "a layer beside plain channels");
}

}  // namespace
}  // namespace dustbench::pictures
