// A table of pictures as other programs write them: format × depth × colour encoding, with the resulting linear light
// or the reason for the refusal.
//
// OpenImageIO's own command makes the files; chunks and profiles that it does not write are added here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "methods/kit/files/input_log.h"
#include "methods/kit/pictures/image.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::pictures {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string bytesOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::filesystem::path drawn(const TestFolder& folder, const std::string& name, const std::string& arguments) {
    std::filesystem::path file = folder.path() / name;
    const std::string command = "oiiotool " + arguments + " -o '" + file.string() + "' > /dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return file;
}

std::string word32(unsigned long value) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xff);
    return text;
}

std::string pngChunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return word32(data.size()) + body + word32(sum);
}

/// A profile with only a description, which readers that do not convert use.
std::string iccProfile(const std::string& description) {
    const std::string text =
        std::string("desc") + word32(0) + word32(description.size() + 1) + description + std::string(79, '\0');
    std::string header(128, '\0');
    header.replace(0, 4, word32(144 + text.size()));
    header.replace(8, 4, word32(0x02100000));
    header.replace(12, 12, "mntrRGB XYZ ");
    header.replace(36, 4, "acsp");
    return header + word32(1) + "desc" + word32(144) + word32(text.size()) + text;
}

std::string iccChunk(const std::string& description) {
    const std::string profile = iccProfile(description);
    std::string packed(compressBound(profile.size()) + 64, '\0');
    uLongf bytes = packed.size();
    // Not made smaller, because libpng drops chunks that are shorter than any complete profile.
    EXPECT_EQ(compress2(reinterpret_cast<Bytef*>(packed.data()), &bytes, reinterpret_cast<const Bytef*>(profile.data()),
                        profile.size(), 0),
              Z_OK);
    packed.resize(bytes);
    return pngChunk("iCCP", std::string("profile") + '\0' + '\0' + packed);
}

struct PictureRow {
    const char *name, *depth;
    std::string chunks{};   ///< of a .png, after its header
    std::string options{};  ///< of oiiotool
    char encoding = 's';    ///< of the colours: 's' sRGB, 'l' linear, '1' power 1.8; 'x' refused
    const char* reason = "";
};

TEST(PictureWall, ColoursAreWhatTheirFilesSay) {
    const TestFolder folder;
    const std::string gamma22 = pngChunk("gAMA", word32(45455)), gamma1 = pngChunk("gAMA", word32(100000)),
                      gamma18 = pngChunk("gAMA", word32(55556)), srgb = pngChunk("sRGB", std::string(1, '\0')),
                      density = pngChunk("pHYs", word32(2835) + word32(2835) + '\1'),
                      primaries = pngChunk("cHRM", word32(31270) + word32(32900) + word32(64000) + word32(33000) +
                                                       word32(30000) + word32(60000) + word32(15000) + word32(6000));
    std::vector<PictureRow> rows;
    for (const char* depth : {"uint8", "uint16"})
        for (const PictureRow& png :
             std::vector<PictureRow>{{"a.png", depth},
                                     {"a.png", depth, srgb},
                                     {"a.png", depth, srgb + gamma22},
                                     {"a.png", depth, gamma22 + primaries},
                                     {"a.png", depth, density},
                                     {"a.png", depth, gamma1, "", 'l'},
                                     {"a.png", depth, gamma18, "", '1'},
                                     {"a.png", depth, iccChunk("sRGB IEC61966-2.1")},
                                     {"a.png", depth, iccChunk("GIMP built-in sRGB")},
                                     {"a.png", depth, iccChunk("Display P3"), "", 'x', "Display P3"},
                                     {"a.png", depth, iccChunk("Adobe RGB (1998)"), "", 'x', "Adobe RGB (1998)"}})
            rows.push_back(png);
    for (const PictureRow& row : std::vector<PictureRow>{
             {"a.jpg", "uint8", "", "--attrib oiio:ColorSpace sRGB"},
             {"a.jpg", "uint8"},
             {"a.tif", "uint8", "", "--attrib oiio:ColorSpace sRGB"},
             {"a.tif", "uint16", "", "--attrib oiio:ColorSpace Linear"},  // TIFF cannot store it
             {"a.tif", "half", "", "", 'l'},
             {"a.tif", "float", "", "", 'l'},
             {"a.tif", "float", "", "--attrib oiio:ColorSpace sRGB"},
             {"a.tif", "uint8", "", "--compression lzw"},
             {"a.tif", "uint16", "", "--planarconfig separate"},
             {"a.tif", "uint8", "", "--tile 16 16"},
             {"a.exr", "half", "", "", 'l'},
             {"a.exr", "half", "", "--compression dwaa", 'l'},
             {"a.exr", "float", "", "--compression pxr24", 'l'},
             {"a.exr", "float", "", "--tile 16 16", 'l'},
             {"a.exr", "half", "", "--attrib:type=float[8] chromaticities 0.64,0.33,0.30,0.60,0.15,0.06,0.3127,0.329",
              'l'},
             {"a.exr", "half", "",
              "--attrib:type=float[8] chromaticities 0.713,0.293,0.165,0.83,0.128,0.044,0.32168,0.33767", 'x',
              "other primaries"},
             {"a.exr", "half", "", "--chnames Y,RY,BY", 'x', "luminance and chroma"},
             {"a.hdr", "float", "", "", 'l'},
             {"a.tga", "uint8"},
             {"a.bmp", "uint8"},
             {"a.ppm", "uint8"},
             {"a.webp", "uint8"},
             {"a.sgi", "uint16"},
             {"a.dpx", "uint10"},
             {"a.dpx", "uint10", "", "--attrib oiio:ColorSpace KodakLog", 'x', "KodakLog"},
         })
        rows.push_back(row);
    for (const PictureRow& row : rows) {
        SCOPED_TRACE(std::string(row.name) + " " + row.depth + " " + row.options + " " + row.encoding);
        const auto file =
            drawn(folder, row.name,
                  "--pattern constant:color=0.6,0.3,0.15 32x32 3 -d " + std::string(row.depth) + " " + row.options);
        if (!row.chunks.empty()) {
            constexpr std::size_t afterHeader = 8 + 25;
            folder.write(row.name, bytesOf(file).insert(afterHeader, row.chunks));
        }
        if (row.encoding == 'x') {
            EXPECT_THAT(inputError([&] { (void)readImage(file); }),
                        testing::AnyOf(HasSubstr(row.reason),
                                       HasSubstr("subsampling factors")));  // newer OpenEXR refuses it itself
            continue;
        }
        const Image image = readImage(file);
        const auto decode = [&](float stored) {
            return row.encoding == 's' ? decodeSrgb(stored) : row.encoding == 'l' ? stored : std::pow(stored, 1.8f);
        };
        ASSERT_EQ(image.width, 32);
        const glm::vec4 first = image.pixels[17 * 32 + 5];
        EXPECT_NEAR(first.r, decode(0.6f), 0.01f);
        EXPECT_NEAR(first.g, decode(0.3f), 0.01f);
        EXPECT_NEAR(first.b, decode(0.15f), 0.01f);
        EXPECT_EQ(first.a, 1);
    }
}

TEST(PictureWall, ChannelsThatNobodyUsesAreNoted) {
    const TestFolder folder;
    const auto ignoredOf = [&](const std::string& name, const std::string& arguments) {
        const auto file = drawn(folder, name, arguments);
        const files::InputLog log;
        (void)readImage(file);
        const auto ignored = log.ignored();
        return ignored.contains(file) ? ignored.at(file) : std::vector<std::string>();
    };
    const std::string five = "--pattern constant:color=0.5,0.25,0.125,1,7 8x8 5 -d float --chnames R,G,B,A,Z";
    EXPECT_THAT(ignoredOf("a.exr", five), ElementsAre("channel 'Z'"));
    EXPECT_THAT(ignoredOf("b.exr", "--pattern constant:color=0.5,0.25 8x8 2 -d float --chnames Y,Z"),
                ElementsAre("channel 'Z'"));
    EXPECT_THAT(ignoredOf("c.exr", "--pattern constant:color=0.5,0.25,0.1,1 8x8 4 -d float"), ElementsAre());
    EXPECT_THAT(ignoredOf("a.png", "--pattern constant:color=0.5,0.25,0.1,1 8x8 4 -d uint8"), ElementsAre());
}

}  // namespace
}  // namespace dustbench::pictures
