#include "methods/kit/pictures/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <random>
#include <string>

#include "methods/kit/pictures/picture_files.h"
#include "methods/kit/pictures/picture_library.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::pictures {
namespace {

namespace fs = std::filesystem;

class ImageFile : public testing::Test {
 protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() / (std::string("dustbench_image_") + info->name());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path folder_;
};

Image randomImage(int width, int height, bool opaque, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> share(0, 1);
    Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i) {
        const float alpha = opaque ? 1.0f : share(engine);
        image.pixels.emplace_back(alpha * share(engine), alpha * share(engine), alpha * share(engine), alpha);
    }
    return image;
}

TEST(Srgb, MeetsTheStandardsConstants) {
    EXPECT_EQ(encodeSrgb(0), 0);
    EXPECT_NEAR(encodeSrgb(1), 1, 1e-7);
    EXPECT_NEAR(encodeSrgb(0.0031308f), 0.04045f, 2e-6f);
    EXPECT_NEAR(encodeSrgb(0.5f), 0.735356983f, 1e-6f);
    EXPECT_NEAR(encodeSrgb(0.18f), 0.461356129f, 1e-6f);
    EXPECT_NEAR(decodeSrgb(0.5f), 0.214041140f, 1e-6f);
    EXPECT_NEAR(encodeSrgb(0.001f), 0.01292f, 1e-8f);
    EXPECT_EQ(encodeSrgb(-1), 0);
    EXPECT_NEAR(encodeSrgb(7), 1, 1e-7);
    EXPECT_EQ(encodeSrgb(NAN), 0);
}

TEST(Srgb, DecodingUndoesEncoding) {
    for (int i = 0; i <= 1000; ++i) {
        const float value = static_cast<float>(i) / 1000;
        EXPECT_NEAR(decodeSrgb(encodeSrgb(value)), value, 3e-7f);
    }
}

TEST(Srgb, RisesWithItsArgument) {
    for (int i = 0; i < 4000; ++i)
        EXPECT_LT(encodeSrgb(static_cast<float>(i) / 4000), encodeSrgb(static_cast<float>(i + 1) / 4000));
}

TEST(Over, EqualsItsFormula) {
    const Image layer{1, 1, {{0.2f, 0.1f, 0.0f, 0.25f}}};
    const Image scene{1, 1, {{0.4f, 0.8f, 2.0f, 1.0f}}};
    const glm::vec4 pixel = over(layer, scene).at(0, 0);
    EXPECT_FLOAT_EQ(pixel.r, 0.2f + 0.75f * 0.4f);
    EXPECT_FLOAT_EQ(pixel.g, 0.1f + 0.75f * 0.8f);
    EXPECT_FLOAT_EQ(pixel.b, 0.75f * 2.0f);
    EXPECT_FLOAT_EQ(pixel.a, 1);
}

TEST(Over, IsAssociative) {
    const Image a = randomImage(9, 7, false, 1), b = randomImage(9, 7, false, 2), c = randomImage(9, 7, true, 3);
    const Image left = over(over(a, b), c), right = over(a, over(b, c));
    for (std::size_t i = 0; i < left.pixels.size(); ++i)
        for (int channel = 0; channel < 4; ++channel)
            EXPECT_NEAR(left.pixels[i][channel], right.pixels[i][channel], 1e-6f);
}

TEST(Over, RefusesDifferentSizes) {
    EXPECT_THROW(static_cast<void>(over(randomImage(2, 3, true, 1), randomImage(3, 2, true, 1))),
                 std::invalid_argument);
}

TEST_F(ImageFile, ExrKeepsEveryBit) {
    Image image = randomImage(13, 5, false, 4);
    image.pixels[3] = {1e-30f, 12345.678f, 0.1f, 1};
    writeImage(image, folder_ / "a.exr");
    const Image back = readImage(folder_ / "a.exr");
    ASSERT_EQ(back.width, 13);
    ASSERT_EQ(back.height, 5);
    EXPECT_EQ(back.pixels, image.pixels);
}

TEST_F(ImageFile, PngRoundsToTheNearestOf256Steps) {
    const Image image = randomImage(16, 16, true, 5);
    writeImage(image, folder_ / "a.png");
    const Image back = readImage(folder_ / "a.png");
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const float step = 255 * encodeSrgb(back.pixels[i][channel]);
            EXPECT_NEAR(step, std::round(step), 1e-3f);
            EXPECT_NEAR(step, 255 * encodeSrgb(image.pixels[i][channel]), 0.501f);
        }
        EXPECT_EQ(back.pixels[i].a, 1);
    }
}

TEST_F(ImageFile, PngHoldsStraightAlphaToWithinItsSteps) {
    const Image image = randomImage(16, 16, false, 6);
    writeImage(image, folder_ / "a.png");
    const Image back = readImage(folder_ / "a.png");
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec4 &got = back.pixels[i], &sent = image.pixels[i];
        EXPECT_NEAR(got.a, sent.a, 0.501f / 255);
        if (sent.a < 0.05f) continue;
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(encodeSrgb(got[channel] / got.a), encodeSrgb(sent[channel] / sent.a), 0.501f / 255);
    }
}

TEST_F(ImageFile, PngReadsTheSameByLibpngAsByOpenImageIo) {
    for (const bool opaque : {true, false}) {
        writeImage(randomImage(16, 16, opaque, 11), folder_ / "a.png");
        StoredPicture ours, theirs;
        ASSERT_EQ(readPicture(folder_ / "a.png", ours), "");
        ASSERT_EQ(pictures::pictureLibrary().read(folder_ / "a.png", theirs), "");
        EXPECT_EQ(ours.channels, opaque ? 3 : 4);
        EXPECT_EQ(ours.channels, theirs.channels);
        EXPECT_EQ(ours.alphaChannel, theirs.alphaChannel);
        EXPECT_EQ(ours.encoding.kind, theirs.encoding.kind);
        EXPECT_EQ(ours.isPremultiplied, theirs.isPremultiplied);
        EXPECT_EQ(ours.values, theirs.values);
    }
}

TEST_F(ImageFile, FirstRowIsTheTop) {
    Image image{2, 2, std::vector<glm::vec4>(4, {0, 0, 0, 1})};
    image.pixels[0] = {1, 0, 0, 1};
    for (const char* name : {"a.png", "a.exr"}) {
        writeImage(image, folder_ / name);
        EXPECT_EQ(readImage(folder_ / name).at(0, 0).r, 1);
        EXPECT_EQ(readImage(folder_ / name).at(0, 1).r, 0);
    }
}

TEST_F(ImageFile, NothingButTheTargetIsLeftInTheFolder) {
    writeImage(randomImage(4, 4, true, 7), folder_ / "a.png");
    writeImage(randomImage(4, 4, true, 8), folder_ / "a.png");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(ImageFile, UnreadableOnesAreNamedInOneLine) {
    const fs::path file = folder_ / "broken.png";
    std::ofstream(file) << "this is no picture";
    const std::string broken = inputError([&] { static_cast<void>(readImage(file)); });
    EXPECT_THAT(broken, testing::HasSubstr("broken.png"));
    EXPECT_EQ(broken.find('\n'), std::string::npos);
    const std::string missing = inputError([&] { static_cast<void>(readImage(folder_ / "missing.exr")); });
    EXPECT_THAT(missing, testing::HasSubstr("missing.exr"));
    EXPECT_EQ(missing.find('\n'), std::string::npos);
}

/// The header of a PNG file, which is all that a decompression bomb needs.
std::string pngHead(std::uint32_t width, std::uint32_t height, int bits, int colours) {
    const auto word = [](std::uint32_t value) {
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
        return bytes;
    };
    const auto crc = [&](const std::string& data) {
        std::uint32_t sum = 0xffffffff;
        for (const char byte : data) {
            sum ^= static_cast<unsigned char>(byte);
            for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? sum >> 1 ^ 0xedb88320 : sum >> 1;
        }
        return word(~sum);
    };
    const std::string head = "IHDR" + word(width) + word(height) + static_cast<char>(bits) +
                             static_cast<char>(colours) + std::string(3, '\0');
    const std::string data = std::string("IDAT") + "\x78\x9c\x03";
    return "\x89PNG\r\n\x1a\n" + word(13) + head + crc(head) + word(3) + data + crc(data);
}

/// Peak memory of the process in kilobytes.
long peakKilobytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

TEST_F(ImageFile, BombsAreRefusedByTheirHeaders) {
    const auto refusal = [&](const std::string& bytes) {
        const fs::path file = folder_ / "bomb.png";
        std::ofstream(file, std::ios::binary) << bytes;
        return inputError([&] { static_cast<void>(readImage(file)); });
    };
    const long before = peakKilobytes();
    for (const int colours : {0, 2, 6})
        EXPECT_THAT(refusal(pngHead(30'000, 30'000, 8, colours)), testing::HasSubstr("allowed: 16384 per side"));
    EXPECT_THAT(refusal(pngHead(30'000, 30'000, 16, 6)), testing::HasSubstr("allowed: 16384 per side"));
    EXPECT_THAT(refusal(pngHead(16'384, 16'384, 8, 2)), testing::HasSubstr("allowed: 1 GB decoded"));
    EXPECT_THAT(refusal(pngHead(8'000, 8'000, 8, 2)), testing::HasSubstr("states too many pixels"));
    testing::internal::CaptureStderr();
    EXPECT_THAT(refusal(pngHead(1'000'000'000, 3, 8, 2)), testing::HasSubstr("bomb.png"));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_LT(peakKilobytes() - before, 200'000);
}

TEST_F(ImageFile, LimitsHoldForOtherFormats) {
    const auto refusal = [&](const std::string& name, const std::string& head) {
        std::ofstream(folder_ / name, std::ios::binary) << head;
        return inputError([&] { static_cast<void>(readImage(folder_ / name)); });
    };
    EXPECT_THAT(refusal("a.pgm", "P5\n20000 2\n255\n"), testing::HasSubstr("allowed: 16384 per side"));
    EXPECT_THAT(refusal("a.ppm", "P6\n16000 16000\n255\n"), testing::HasSubstr("allowed: 1 GB decoded"));
    EXPECT_THAT(inputError([&] { static_cast<void>(readImage("/dev/zero")); }), testing::HasSubstr("is a device"));
    EXPECT_EQ(tooLarge(8192, 8192, 4), "");
    EXPECT_EQ(tooLarge(16'384, 4096, 4), "");
    EXPECT_NE(tooLarge(8192, 8193, 4), "");
    EXPECT_NE(tooLarge(16'385, 1, 1), "");
    EXPECT_NE(tooLarge(16'384, 16'384, 2'000'000'000), "");
}

TEST_F(ImageFile, CutOffOnesAreRefused) {
    const fs::path file = folder_ / "cut.exr";
    writeImage(randomImage(64, 64, true, 9), file);
    fs::resize_file(file, fs::file_size(file) / 2);
    EXPECT_THAT(inputError([&] { static_cast<void>(readImage(file)); }), testing::HasSubstr("cut.exr"));
}

TEST_F(ImageFile, UnwritableTargetsAreNamedInOneLine) {
    const Image image = randomImage(2, 2, true, 10);
    const std::string folder = inputError([&] { writeImage(image, folder_ / "none" / "a.png"); });
    EXPECT_THAT(folder, testing::HasSubstr("a.png"));
    EXPECT_EQ(folder.find('\n'), std::string::npos);
    EXPECT_THAT(inputError([&] { writeImage(image, folder_ / "a.jpg"); }), testing::HasSubstr("expected .png or .exr"));
    EXPECT_THAT(inputError([&] { writeImage(Image{}, folder_ / "a.png"); }), testing::HasSubstr("no pixels"));
}

}  // namespace
}  // namespace dustbench::pictures
