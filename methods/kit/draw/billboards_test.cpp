#include "methods/kit/draw/billboards.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/maths/transmittance.h"
#include "source_folder.h"

namespace dustbench::draw {
namespace {

struct Puff {
    glm::vec3 centre;
    float radius, opacity;
    glm::vec3 colour{1};
    float frame = 0;
};

/// A canvas that looks along −z from an eye away from the origin.
class Canvas : public TestCanvas {
 public:
    Canvas() : TestCanvas(160, 120, {100.5, 2.25, -40.125}, {0, 0, -1}) {}

    pictures::Image draw(Billboards& billboards, const std::vector<Puff>& puffs, bool coloured = false) {
        const auto layout = billboards.layout(coloured);
        const auto values = billboards.map(puffs.size(), layout);
        std::size_t next = 0;
        const auto put = [&](float value) { values[next++] = value; };
        for (const Puff& puff : puffs) {
            for (int i = 0; i < 3; ++i) put(puff.centre[i]);
            put(puff.radius);
            put(puff.opacity);
            if (billboards.framed()) put(puff.frame);
            for (int i = 0; layout.coloured && i < 3; ++i) put(puff.colour[i]);
        }
        billboards.unmap();
        return drawAgain(billboards);
    }
    pictures::Image drawAgain(Billboards& billboards) {
        return picture([&](const gpu::Layer& layer) { billboards.draw(view, colourOfAll, layer); });
    }

    /// Opacity of a puff along a pixel's ray; if `soft`, cut at `wall` along the axis and at the eye.
    struct Expected {
        double opacity;
        double planeOffset;  ///< offset of the ray from the centre, in the plane through the centre that faces the eye
    };
    [[nodiscard]] Expected expected(const Puff& puff, int x, int y, std::optional<double> wall = {},
                                    bool soft = false) const {
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const glm::dvec3 centre = glm::dvec3(puff.centre) - view.camera.eye;
        const double foot = glm::dot(ray, centre);
        const double b = glm::length(centre - foot * ray);
        const auto alpha = static_cast<double>(puff.opacity);
        const auto radius = static_cast<double>(puff.radius);
        const double offset = foot > 0 ? b * glm::length(centre) / foot : 1e9;
        if (!soft) return {maths::billboardOpacity(alpha, radius, b), offset};
        const double end = wall ? *wall / -ray.z : 1e9;
        return {-std::expm1(-maths::rayOpticalDepth(alpha, radius, b, foot, 0, end)), offset};
    }

    glm::vec3 colourOfAll{0.5f, 0.25f, 0.125f};
};

/// GPUs place a quad's corners, and with them the puff, in steps of 1/256 of a pixel.
double roundingTolerance() {
    return Canvas::device().isSoftware() ? 1e-5 : 4e-5;
}

void expectPuff(const Canvas& canvas, const pictures::Image& image, const Puff& puff, double tolerance,
                std::optional<double> wall = {}, bool soft = false) {
    int drawn = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto [opacity, offset] = canvas.expected(puff, x, y, wall, soft);
            const auto alpha = static_cast<double>(image.at(x, y).a);
            const auto radius = static_cast<double>(puff.radius);
            if (offset > 1.5 * std::numbers::sqrt2 * radius * 1.001) {
                ASSERT_EQ(alpha, 0) << x << ',' << y << ": outside the quad";
            } else if (offset < 1.499 * radius) {
                ASSERT_NEAR(alpha, opacity, tolerance) << x << ',' << y;
                ++drawn;
            }
        }
    EXPECT_GT(drawn, 20);
}

TEST(Billboards, ShowThePuffsOpacityAlongEachRay) {
    Canvas canvas;
    Billboards billboards(Canvas::device(), {});
    for (const Puff& puff : {Puff{canvas.at({0, 0, -20}), 1.0f, 0.5f}, Puff{canvas.at({-5, 3, -12}), 2.0f, 0.999f},
                             Puff{canvas.at({0.7f, -0.2f, -2}), 0.8f, 0.02f}, Puff{canvas.at({0, 0.5f, -1}), 1, 0.3f}})
        expectPuff(canvas, canvas.draw(billboards, {puff}), puff, roundingTolerance());
}

TEST(Billboards, OfPlainAlphaAreCirclesThatFadeFromTheirMiddleToTheirRim) {
    Canvas canvas;
    Billboards billboards(Canvas::device(), {.plainAlpha = true});
    for (const Puff& puff : {Puff{canvas.at({0, 0, -20}), 1.5f, 0.5f}, Puff{canvas.at({-5, 3, -12}), 2.0f, 0.999f},
                             Puff{canvas.at({0.7f, -0.2f, -2}), 0.4f, 0.02f}}) {
        const pictures::Image image = canvas.draw(billboards, {puff});
        int drawn = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const double u =
                    std::min(canvas.expected(puff, x, y).planeOffset / (1.5 * static_cast<double>(puff.radius)), 1.0);
                ASSERT_NEAR(image.at(x, y).a, static_cast<double>(puff.opacity) * (1 - 3 * u * u + 2 * u * u * u),
                            roundingTolerance())
                    << x << ',' << y;
                drawn += u < 1 ? 1 : 0;
            }
        EXPECT_GT(drawn, 100);
    }
}

TEST(Billboards, ArePremultipliedWithTheirColour) {
    Canvas canvas;
    Billboards billboards(Canvas::device(), {});
    const Puff puff{canvas.at({0, 0, -10}), 1, 0.8f, {0.1f, 0.2f, 0.9f}};
    for (const bool coloured : {false, true}) {
        const glm::vec3 colour = coloured ? puff.colour : canvas.colourOfAll;
        const pictures::Image image = canvas.draw(billboards, {puff}, coloured);
        for (const glm::vec4& pixel : image.pixels)
            for (int i = 0; i < 3; ++i) ASSERT_NEAR(pixel[i], colour[i] * pixel.a, 1e-6);
    }
}

TEST(Billboards, TransmittancesMultiplyWhateverTheOrder) {
    Canvas canvas;
    Billboards billboards(Canvas::device(), {});
    const Puff near{canvas.at({0.5f, 0, -8}), 1.2f, 0.6f}, far{canvas.at({-0.5f, 0.3f, -14}), 2, 0.7f};
    const pictures::Image alone = canvas.draw(billboards, {near}), other = canvas.draw(billboards, {far});
    const pictures::Image both = canvas.draw(billboards, {far, near}), reversed = canvas.draw(billboards, {near, far});
    for (std::size_t i = 0; i < both.pixels.size(); ++i) {
        const float expected = 1 - (1 - alone.pixels[i].a) * (1 - other.pixels[i].a);
        ASSERT_NEAR(both.pixels[i].a, expected, 1e-6);
        ASSERT_NEAR(reversed.pixels[i].a, expected, 1e-6);
    }
}

TEST(Billboards, AreHiddenBehindWhatIsSolid) {
    Canvas canvas;
    Billboards billboards(Canvas::device(), {});
    const Puff puff{canvas.at({0, 0, -10}), 1, 0.8f};
    const pictures::Image free = canvas.draw(billboards, {puff});
    for (const double wall : {9.9, 10.1}) {
        canvas.setWall(wall, 80);
        const pictures::Image image = canvas.draw(billboards, {puff});
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                ASSERT_EQ(image.at(x, y).a, x >= 80 && wall < 10 ? 0 : free.at(x, y).a) << x << ',' << y;
    }
}

TEST(Billboards, EndSoftlyAtTheScene) {
    Canvas canvas;
    for (const Facing facing : {Facing::viewpoint, Facing::viewplane}) {
        Billboards billboards(Canvas::device(), {facing, true});
        for (const double wall : {8.5, 9.5, 10.0, 10.2, 11.5, 20.0}) {
            canvas.setWall(wall);
            // In the middle of the view both facings measure the same b.
            const Puff puff{canvas.at({0, 0, -10}), 1, 0.9f};
            expectPuff(canvas, canvas.draw(billboards, {puff}), puff, facing == Facing::viewpoint ? 1e-5 : 6e-3, wall,
                       true);
        }
    }
    Billboards billboards(Canvas::device(), {Facing::viewpoint, true});
    canvas.setWall(7);
    const Puff aside{canvas.at({4, -2, -7}), 1.5f, 0.6f};
    expectPuff(canvas, canvas.draw(billboards, {aside}), aside, 1e-5, 7, true);
    canvas.setWall(std::nullopt);
    const Puff aroundTheEye{canvas.at({0, 0.1f, -0.5f}), 1, 0.6f};
    expectPuff(canvas, canvas.draw(billboards, {aroundTheEye}), aroundTheEye, 1e-5, std::nullopt, true);
}

TEST(Billboards, OfTheViewplaneComeNearThoseOfTheViewpoint) {
    Canvas canvas;
    Billboards billboards(Canvas::device(), {Facing::viewplane, false});
    const Puff puff{canvas.at({0, 0, -10}), 1, 0.5f};
    expectPuff(canvas, canvas.draw(billboards, {puff}), puff, 2e-3);
}

TEST(Billboards, CopeWithPuffsAtAndBehindTheEye) {
    Canvas canvas;
    for (const bool soft : {false, true}) {
        Billboards billboards(Canvas::device(), {Facing::viewpoint, soft});
        const Puff seen{canvas.at({0, 0, -10}), 1, 0.5f};
        const pictures::Image alone = canvas.draw(billboards, {seen});
        const pictures::Image crowd = canvas.draw(billboards, {{canvas.at({0, 0, 30}), 5, 0.9f},
                                                               {canvas.at({0, 0, 0}), 1, 0.9f},
                                                               {canvas.at({0, 5, 0}), 1, 0.9f},
                                                               {canvas.at({0, 0, -0.05f}), 0.02f, 0.9f},
                                                               seen,
                                                               {canvas.at({1, 0, -10}), 0, 0.9f},
                                                               {canvas.at({1, 0, -10}), 1, 0}});
        for (std::size_t i = 0; i < alone.pixels.size(); ++i)
            for (int c = 0; c < 4; ++c) ASSERT_NEAR(crowd.pixels[i][c], alone.pixels[i][c], 1e-6);
    }
}

TEST(Billboards, DrawAllThereAreAndTheSameAgain) {
    Canvas canvas;
    Billboards billboards(Canvas::device(), {});
    for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 200u, 7u}) {
        // Thin puffs at the same place: their depths add up.
        const std::vector<Puff> puffs(count, Puff{canvas.at({0, 0, -10}), 2, 0.01f});
        const pictures::Image image = canvas.draw(billboards, puffs);
        EXPECT_EQ(billboards.count(), count);
        EXPECT_NEAR(image.at(80, 60).a, 1 - std::pow(0.99, static_cast<double>(count)), 2e-3) << count;
        EXPECT_EQ(canvas.drawAgain(billboards).pixels, image.pixels);
    }
}

TEST(Billboards, TakeAMillion) {
    Canvas canvas;
    Billboards billboards(Canvas::device(), {});
    const Puff puff{canvas.at({0, 0, -10}), 0.1f, 4e-6f};
    const pictures::Image image = canvas.draw(billboards, std::vector<Puff>(1'000'000, puff));
    // Depths add up. An α of about 1e-6 has only a few digits in a float, and blending rounds a million times.
    const double depth = -1e6 * std::log1p(-canvas.expected(puff, 80, 60).opacity);
    EXPECT_NEAR(-std::log1p(-static_cast<double>(image.at(80, 60).a)), depth, 0.1 * depth);
    EXPECT_GE(billboards.gpuBytes(), 20'000'000u);
}

std::filesystem::path textures(const char* name) {
    return std::filesystem::path(DUSTBENCH_SOURCE_DIR) / "data/textures" / name;
}

/// Optical depth summed over the picture.
double totalDepth(const pictures::Image& image) {
    double total = 0;
    for (const glm::vec4& pixel : image.pixels) total -= std::log1p(-static_cast<double>(pixel.a));
    return total;
}

TEST(PuffTextures, KeepTheMassAndTheColourOfThePuff) {
    Canvas canvas;
    canvas.view.camera.verticalFieldOfView = 0.1;  // from far away, where rays are nearly parallel
    Billboards plain(Canvas::device(), {});
    for (const char* name : {"puff.png", "puffs.png", "puff_animated.png"}) {
        const PuffTextures pictures(Canvas::device(), textures(name), PuffTextures::Frames::separate);
        Billboards pictured(Canvas::device(), {}, &pictures);
        for (int frame = 0; frame < pictures.frames(); ++frame) {
            const Puff puff{canvas.at({0, 0, -90}), 2, 0.5f, glm::vec3(1), static_cast<float>(frame)};
            const pictures::Image expected = canvas.draw(plain, {puff}), got = canvas.draw(pictured, {puff});
            EXPECT_NEAR(totalDepth(got) / totalDepth(expected), 1, 0.01) << name << ' ' << frame;
            double light = 0, alpha = 0;
            for (const glm::vec4& pixel : got.pixels) {
                light += static_cast<double>(pixel.g / canvas.colourOfAll.g);
                alpha += static_cast<double>(pixel.a);
            }
            EXPECT_NEAR(light / alpha, 1, 0.05) << name << ' ' << frame;
        }
    }
}

TEST(PuffTextures, CrossFadeBetweenNeighbours) {
    Canvas canvas;
    const PuffTextures pictures(Canvas::device(), textures("puff_animated.png"), PuffTextures::Frames::crossFaded);
    Billboards billboards(Canvas::device(), {}, &pictures);
    Puff puff{canvas.at({0, 0, -10}), 2, 0.5f};
    std::vector<pictures::Image> images;
    for (const float frame : {3.0f, 4.0f, 3.25f, 11.0f}) {
        puff.frame = frame;
        images.push_back(canvas.draw(billboards, {puff}));
    }
    for (std::size_t i = 0; i < images[0].pixels.size(); ++i) {
        const auto depth = [&](int image) { return -std::log1p(-images[static_cast<std::size_t>(image)].pixels[i].a); };
        ASSERT_NEAR(depth(2), 0.75f * depth(0) + 0.25f * depth(1), 2e-5);
    }
    EXPECT_NE(images[3].pixels, images[0].pixels);
}

TEST(PuffTextures, PlayAVideoAsALoopAsBrightAsRecorded) {
    // Three frames of alphas 0.8, 0.2 and 0.4, and of brightness 0.25, 1 and 0.5.
    const auto file = std::filesystem::temp_directory_path() / "dustbench_video_puff.exr";
    constexpr float alphas[] = {0.8f, 0.2f, 0.4f}, lights[] = {0.25f, 1, 0.5f};
    pictures::Image strip{12, 4, std::vector<glm::vec4>(48)};
    for (std::size_t i = 0; i < strip.pixels.size(); ++i) {
        const std::size_t frame = i % 12 / 4;
        strip.pixels[i] = alphas[frame] * glm::vec4(glm::vec3(lights[frame]), 1);
    }
    pictures::writeImage(strip, file);
    const PuffTextures video(Canvas::device(), file, PuffTextures::Frames::looped);
    std::filesystem::remove(file);
    ASSERT_EQ(video.frames(), 3);

    Canvas canvas;
    Billboards billboards(Canvas::device(), {}, &video);
    Puff puff{canvas.at({0, 0, -10}), 2, 0.5f};
    const auto seen = [&](float frame) {
        puff.frame = frame;
        const pictures::Image image = canvas.draw(billboards, {puff});
        const glm::vec4 middle = image.pixels[static_cast<std::size_t>(60 * image.width + 80)];
        return std::pair(-std::log1p(-middle.a), middle.g / middle.a);  // depth and brightness
    };
    const auto [depth, light] = seen(0);
    for (int frame = 1; frame < 3; ++frame) {
        const auto [depthThen, lightThen] = seen(static_cast<float>(frame));
        EXPECT_NEAR(depthThen / depth, alphas[frame] / alphas[0], 0.01) << frame;
        EXPECT_NEAR(lightThen / light, lights[frame] / lights[0], 0.02) << frame;
    }
    // The last frame fades into the first.
    EXPECT_NEAR(seen(2.25f).first, 0.75f * seen(2).first + 0.25f * depth, 1e-4);
    EXPECT_NEAR(seen(2.999f).first, depth, 2e-3 * static_cast<double>(depth));
}

TEST(PuffTextures, SayWhatIsWrongWithAFileInOneLine) {
    const auto folder = std::filesystem::temp_directory_path();
    const auto broken = folder / "dustbench_broken_puff.png", oblong = folder / "dustbench_oblong_puff.png",
               empty = folder / "dustbench_empty_puff.png";
    std::ofstream(broken) << "no picture";
    pictures::writeImage({7, 3, std::vector<glm::vec4>(21, glm::vec4(0.5f))}, oblong);
    pictures::writeImage({4, 4, std::vector<glm::vec4>(16, glm::vec4(0))}, empty);
    for (const auto& file : {folder / "dustbench_no_such_puff.png", broken, oblong, empty}) {
        try {
            const PuffTextures none(Canvas::device(), file, PuffTextures::Frames::separate);
            FAIL() << file;
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find(file.filename().string()), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
    for (const auto& file : {broken, oblong, empty}) std::filesystem::remove(file);
}

}  // namespace
}  // namespace dustbench::draw
