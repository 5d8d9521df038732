// End-to-end tests of `diff`: its output for two files, and invalid input.
#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "bench/cli/called_program.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;

class DiffCommand : public Dustbench {
 protected:
    /// A gradient; its left half is brightened by `brighter`.
    static pictures::Image gradient(int width, int height, float brighter) {
        pictures::Image image{width, height, {}};
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float value = 0.2f + 0.5f * static_cast<float>(x + y) / static_cast<float>(width + height);
                image.pixels.emplace_back(glm::vec3(value + (2 * x < width ? brighter : 0)), 1.0f);
            }
        return image;
    }
    std::string write(const std::string& name, const pictures::Image& image) const {
        const fs::path file = folder_ / name;
        pictures::writeImage(image, file);
        return "'" + file.string() + "'";
    }
    [[nodiscard]] Called diff(const std::string& a, const std::string& b, const std::string& more = "") const {
        return call("diff " + a + " " + b + " " + more);
    }
    /// Exit 3, one line on stderr, nothing on stdout.
    void expectRefused(const Called& called, const std::string& reason) const {
        EXPECT_EQ(called.code, 3) << called.err;
        EXPECT_THAT(called.err, HasSubstr(reason));
        EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
        EXPECT_EQ(called.out, "");
    }
};

TEST_F(DiffCommand, CallsAFileIdenticalToItself) {
    const std::string file = write("a.png", gradient(40, 30, 0));
    const Called called = diff(file, file, "--json");
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_EQ(nlohmann::json::parse(called.out), nlohmann::json::parse(R"({"psnr_db": null, "ssim": 1.0, "flip": 0.0,
        "rmse_linear": 0.0, "identical": true})"));
    EXPECT_THAT(diff(file, file).out, testing::ContainsRegex("identical +1 "));
}

TEST_F(DiffCommand, GivesTheSameNumbersAsTableAndAsJson) {
    const std::string a = write("a.exr", gradient(40, 30, 0)), b = write("b.exr", gradient(40, 30, 0.1f));
    const Called json = diff(a, b, "--json"), table = diff(a, b);
    ASSERT_EQ(json.code, 0) << json.err;
    ASSERT_EQ(table.code, 0) << table.err;
    const auto object = nlohmann::json::parse(json.out);
    // Half of the pixels differ by 0.1 of linear light in all channels.
    EXPECT_NEAR(object["rmse_linear"].get<double>(), 0.1 / std::sqrt(2.0), 1e-6);
    EXPECT_EQ(object["identical"], false);
    EXPECT_GT(object["flip"].get<double>(), 0.02);
    for (const char* name : {"psnr_db", "ssim", "flip", "rmse_linear"}) {
        const std::string shown = fmt::format("{:.4f}", object[name].get<double>());
        EXPECT_THAT(table.out, HasSubstr(shown.substr(0, shown.size() - 1))) << name;
    }
}

TEST_F(DiffCommand, ReadsAnEncodedPngAndALinearExrAsTheSamePicture) {
    const pictures::Image image = gradient(64, 48, 0);
    const Called called = diff(write("a.exr", image), write("a.png", image), "--json");
    ASSERT_EQ(called.code, 0) << called.err;
    // Only the rounding to 256 steps remains: an RMS of about 1/√12 of a step, 58.9 dB.
    const auto object = nlohmann::json::parse(called.out);
    EXPECT_NEAR(object["psnr_db"].get<double>(), 20 * std::log10(255 * std::sqrt(12.0)), 1);
    EXPECT_LT(object["flip"].get<double>(), 0.01);
}

TEST_F(DiffCommand, WritesAHeatMapThatIsBrightWhereThePicturesDiffer) {
    const std::string a = write("a.png", gradient(64, 48, 0)), b = write("b.png", gradient(64, 48, 0.3f));
    const fs::path map = folder_ / "map.png";
    ASSERT_EQ(diff(a, b, "--out '" + map.string() + "'").code, 0);
    const pictures::Image image = pictures::readImage(map);
    ASSERT_EQ(image.width, 64);
    ASSERT_EQ(image.height, 48);
    EXPECT_GT(image.at(8, 24).r, 5 * image.at(56, 24).r);
    EXPECT_EQ(image.at(8, 24).a, 1);
}

TEST_F(DiffCommand, SeesLessFromFartherAway) {
    // Stripes one pixel wide: with more pixels per degree, an observer sees them blurred.
    pictures::Image stripes = gradient(64, 48, 0), even = stripes;
    for (std::size_t i = 0; i < stripes.pixels.size(); ++i)
        stripes.pixels[i] += glm::vec4(glm::vec3(i % 2 ? 0.1f : -0.1f), 0);
    const std::string a = write("a.exr", even), b = write("b.exr", stripes);
    const auto flip = [&](const char* distance) {
        return nlohmann::json::parse(diff(a, b, std::string("--json --pixels-per-degree ") + distance).out)["flip"]
            .get<double>();
    };
    EXPECT_GT(flip("15"), 1.5 * flip("120"));
}

TEST_F(DiffCommand, RefusesWhatItCannotCompareInOneLine) {
    const std::string good = write("good.exr", gradient(40, 30, 0));
    expectRefused(diff(good, write("small.png", gradient(30, 40, 0))), "images differ in size");
    expectRefused(diff(good, "'" + (folder_ / "missing.png").string() + "'"), "missing.png");
    expectRefused(diff("'" + folder_.string() + "'", good), "it is a folder");

    std::ofstream(folder_ / "text.png") << "not a picture";
    expectRefused(diff(good, "'" + (folder_ / "text.png").string() + "'"), "text.png");

    pictures::Image broken = gradient(40, 30, 0);
    broken.pixels[40 * 7 + 5].r = std::numeric_limits<float>::quiet_NaN();
    broken.pixels[40 * 9].b = std::numeric_limits<float>::infinity();
    expectRefused(diff(good, write("broken.exr", broken)), "broken.exr': 2 pixels are not finite, the first at (5, 7)");

    pictures::Image clear = gradient(40, 30, 0);
    clear.pixels[3].a = 0.25f;
    expectRefused(diff(write("clear.png", clear), good), "clear.png': 1 pixel is not opaque (expected alpha 1)");

    expectRefused(diff(good, good, "--pixels-per-degree 0"), "allowed: number 1..1000");
    expectRefused(diff(good, good, "--out map.jpg"), "--out: got 'map.jpg', allowed: a file that ends in .png");
    expectRefused(diff(good, good, "--out '" + (folder_ / "none" / "map.png").string() + "'"), "cannot be written");
    expectRefused(call("diff " + good), "image");
}

}  // namespace
}  // namespace dustbench::cli
