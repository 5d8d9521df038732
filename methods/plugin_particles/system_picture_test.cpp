#include "methods/plugin_particles/system_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "methods/contract/errors.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/plugin_particles/brightness_experiment.h"

namespace dustbench::plugin_particles {
namespace {

using particles::Look;
using particles::NamedValues;

Look lookOf(const char* part, const NamedValues& values = {}) {
    return particles::makePartOf<particles::RenderPart>(particles::PartKind::render, part, values)->look();
}

/// A few particles in front of an eye that looks along −Z, in a picture of 160 x 120.
class Canvas : public TestMoment {
 public:
    explicit Canvas(std::size_t count) : TestMoment(count, 160, 120, {0, 0, 0}, {0, 0, -1}) {
        dust.keepOneColour(false);
        for (std::size_t i = 0; i < count; ++i) put(i, 80, 60, 10, {1, 0.5f, 0.25f}, 0.5f);
    }

    /// Particle `i` in the middle of a pixel, at a distance along the axis.
    void put(std::size_t i, int x, int y, float distance, const glm::vec3& colour, float opacity) {
        const glm::vec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const glm::vec3 at = ray * (distance / -ray.z);
        dust.serial[i] = i;
        dust.x[i] = at.x, dust.y[i] = at.y, dust.z[i] = at.z;
        dust.velocityX[i] = dust.velocityY[i] = dust.velocityZ[i] = 0;
        dust.red[i] = colour.r, dust.green[i] = colour.g, dust.blue[i] = colour.b;
        dust.opacity[i] = opacity, dust.radius[i] = 0.5f;
        dust.age[i] = 1, dust.lifetime[i] = 2;
    }
    [[nodiscard]] float pixelMetres(float distance) const { return distance / (view.eyeToClip()[1][1] * 60); }

    pictures::Image drawn(const Look& look) {
        SystemPicture shown(device(), look, scene.lights);
        shown.upload({dust, glm::vec3(view.camera.eye), 1.0f / 60}, StageClock());
        pictures::Image first = picture([&](gpu::Layer& layer) { shown.draw(view, layer); });
        EXPECT_EQ(first.pixels, picture([&](gpu::Layer& layer) { shown.draw(view, layer); }).pixels);
        return first;
    }
};

glm::vec4 at(const pictures::Image& image, int x, int y) {
    return image.pixels[static_cast<std::size_t>(y * image.width + x)];
}

void expectNear(const glm::vec4& got, const glm::vec4& expected, float within = 1e-6f) {
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(got[c], expected[c], within) << "channel " << c;
}

TEST(SystemPicture, AddedLightAddsUpAndIsClampedInABufferOfItsOwn) {
    for (const int count : {1, 2, 3}) {
        Canvas canvas(static_cast<std::size_t>(count));
        const float sum = 0.5f * static_cast<float>(count);
        const glm::vec4 light(sum, 0.5f * sum, 0.25f * sum, 0);
        expectNear(at(canvas.drawn(lookOf("points", {{"clamped", "off"}})), 80, 60), light);
        expectNear(at(canvas.drawn(lookOf("points")), 80, 60), glm::min(light, glm::vec4(1)));
    }
}

TEST(SystemPicture, AlphaIsSortedWhateverTheOrderOfTheParticles) {
    for (const std::size_t near : {0u, 1u}) {
        Canvas canvas(2);
        canvas.put(near, 80, 60, 5, {1, 0, 0}, 0.5f);
        canvas.put(1 - near, 80, 60, 10, {0, 1, 0}, 0.5f);
        const pictures::Image image = canvas.drawn(lookOf("points", {{"blend", "alpha"}}));
        expectNear(at(image, 80, 60), {0.5f, 0.25f, 0, 0.75f});
    }
}

/// ∫ α·(1 − t) dt over a line of L pixels is α·L/2; without the fade it is α·L.
TEST(SystemPicture, ALineFadesLinearlyToItsOldEnd) {
    for (const bool fade : {true, false})
        for (const float seconds : {0.1f, 0.4f}) {
            Canvas canvas(1);
            canvas.put(0, 120, 60, 10, {1, 1, 1}, 0.8f);
            canvas.dust.velocityX[0] = 10;
            const pictures::Image image = canvas.drawn(lookOf(
                "lines", {{"blend", "alpha"}, {"seconds", std::to_string(seconds)}, {"fade", fade ? "on" : "off"}}));
            float sum = 0, before = 2;
            for (int x = 120; x >= 0; --x) {
                const float alpha = at(image, x, 60).a;
                sum += alpha;
                EXPECT_TRUE(!fade || alpha == 0 || alpha < before) << x;
                if (alpha > 0) before = alpha;
            }
            const float pixels = 10 * seconds / canvas.pixelMetres(10);
            EXPECT_NEAR(sum, 0.8f * pixels * (fade ? 0.5f : 1), 0.8f) << seconds;  // one pixel at either end
            EXPECT_EQ(at(image, 124, 60).a, 0);
        }
}

TEST(SystemPicture, ALineOfANewbornBeginsWhereItWasBorn) {
    Canvas canvas(1);
    canvas.dust.velocityX[0] = 10;
    canvas.dust.age[0] = 0.05f;
    const pictures::Image image =
        canvas.drawn(lookOf("lines", {{"seconds", "1"}, {"fade", "off"}, {"blend", "alpha"}}));
    float sum = 0;
    for (const glm::vec4& pixel : image.pixels) sum += pixel.a;
    EXPECT_NEAR(sum, 0.5f * 0.5f / canvas.pixelMetres(10), 0.5f);
}

TEST(SystemPicture, AHybridIsItsLineAndItsPoint) {
    Canvas canvas(1);
    canvas.dust.velocityX[0] = 10;
    const NamedValues both{{"clamped", "off"}, {"seconds", "0.1"}};
    const pictures::Image hybrid = canvas.drawn(lookOf("hybrid", {{"clamped", "off"}, {"seconds", "0.1"}}));
    const pictures::Image line = canvas.drawn(lookOf("lines", both));
    const pictures::Image point = canvas.drawn(lookOf("points", {{"clamped", "off"}, {"pixels", "1"}}));
    for (std::size_t i = 0; i < hybrid.pixels.size(); ++i)
        expectNear(hybrid.pixels[i], line.pixels[i] + point.pixels[i]);
    EXPECT_GT(at(point, 80, 60).r, 0.4f);
}

TEST(SystemPicture, ASpriteWithAVideoPlaysItInALoopFromAFrameOfItsOwn) {
    Canvas canvas(1);
    const auto after = [&](float seconds, std::uint64_t serial) {
        canvas.dust.age[0] = seconds, canvas.dust.serial[0] = serial;
        return canvas.drawn(lookOf("sprites", {{"picture", "fire_video"}, {"frames_per_second", "12"}})).pixels;
    };
    constexpr float loop = 2;  // of 24 frames
    EXPECT_EQ(after(0, 0), after(loop, 0));
    EXPECT_EQ(after(0.75f, 0), after(0.75f + 3 * loop, 0));
    EXPECT_NE(after(0, 0), after(0.5f, 0));
    EXPECT_NE(after(0, 0), after(0, 1));
    // Without a rate, a sprite shows one frame all its life.
    const auto still = [&](float seconds) {
        canvas.dust.age[0] = seconds;
        return canvas.drawn(lookOf("sprites", {{"picture", "fire_video"}})).pixels;
    };
    EXPECT_EQ(still(0), still(0.5f));
}

TEST(SystemPicture, AVideoNeedsAPicture) {
    EXPECT_THROW(static_cast<void>(lookOf("sprites", {{"frames_per_second", "12"}})), InputError);
}

TEST(SystemPicture, TheLeftEyeIsGreenAndTheRightOneRed) {
    Canvas canvas(1);
    const float luminance = 0.2126f + 0.7152f * 0.5f + 0.0722f * 0.25f;
    for (const auto& [blend, alpha] : {std::pair("additive", 0.0f), std::pair("alpha", 0.25f)}) {
        // Each eye sees the point 6 pixels from the middle.
        const std::string eyes = std::to_string(12 * canvas.pixelMetres(10));
        const pictures::Image image = canvas.drawn(
            lookOf("points", {{"pixels", "1"}, {"blend", blend}, {"stereo", "on"}, {"eyes_metres", eyes}}));
        expectNear(at(image, 86, 60), {0, 0.5f * luminance, 0, alpha}, 1e-5f);
        expectNear(at(image, 74, 60), {0.5f * luminance, 0, 0, alpha}, 1e-5f);
        expectNear(at(image, 80, 60), glm::vec4(0));
        // With both eyes at one place the pictures coincide: yellow.
        expectNear(at(canvas.drawn(lookOf("points",
                                          {{"pixels", "1"}, {"blend", blend}, {"stereo", "on"}, {"eyes_metres", "0"}})),
                      80, 60),
                   {0.5f * luminance, 0.5f * luminance, 0, 2 * alpha}, 1e-5f);
    }
}

TEST(SystemPicture, AccumulationIsTheMeanOfThePicturesOfItsMoments) {
    constexpr int copies = 5;
    for (const char* blend : {"additive", "alpha"})
        for (const bool fade : {false, true}) {
            Canvas canvas(3);
            canvas.put(0, 70, 60, 8, {1, 0.2f, 0.1f}, 0.9f);
            canvas.put(1, 80, 50, 10, {0.1f, 0.9f, 0.4f}, 0.7f);
            canvas.put(2, 76, 62, 13, {0.5f, 0.5f, 0.9f}, 0.8f);
            // No particle overtakes another, so the drawing order is the same at all times.
            canvas.dust.velocityX[0] = 2, canvas.dust.velocityY[1] = -3, canvas.dust.velocityZ[2] = 2;
            const pictures::Image got = canvas.drawn(lookOf("aa_sprites", {{"by", "accumulation"},
                                                                           {"copies", std::to_string(copies)},
                                                                           {"seconds", "0.5"},
                                                                           {"fade", fade ? "on" : "off"},
                                                                           {"blend", blend}}));
            std::vector<glm::vec4> mean(got.pixels.size(), glm::vec4(0));
            for (int k = 0; k < copies; ++k) {
                Canvas moment(3);
                const float back = 0.5f * static_cast<float>(copies - 1 - k) / copies;
                for (std::size_t i = 0; i < 3; ++i) {
                    moment.put(i, 80, 60, 10, canvas.dust.colour(i), canvas.dust.opacity[i]);
                    moment.dust.x[i] = canvas.dust.x[i] - back * canvas.dust.velocityX[i];
                    moment.dust.y[i] = canvas.dust.y[i] - back * canvas.dust.velocityY[i];
                    moment.dust.z[i] = canvas.dust.z[i] - back * canvas.dust.velocityZ[i];
                }
                const pictures::Image one = moment.drawn(lookOf("sprites", {{"blend", blend}}));
                const float weight = fade ? 2 * static_cast<float>(k + 1) / (copies * (copies + 1)) : 1.0f / copies;
                for (std::size_t p = 0; p < mean.size(); ++p) mean[p] += weight * one.pixels[p];
            }
            float brightest = 0;
            for (std::size_t p = 0; p < mean.size(); ++p) {
                expectNear(got.pixels[p], mean[p], 2e-6f);
                brightest = std::max(brightest, mean[p].g);
            }
            EXPECT_GT(brightest, 0.2f);
        }
}

TEST(SystemPicture, TheCopiesOfASpriteThatStandsAreTheSprite) {
    for (const char* blend : {"additive", "alpha"})
        for (const char* fade : {"on", "off"}) {
            Canvas canvas(2);
            canvas.put(1, 84, 62, 12, {0.3f, 0.6f, 0.9f}, 0.95f);
            const pictures::Image sprite = canvas.drawn(lookOf("sprites", {{"blend", blend}, {"clamped", "off"}}));
            // Alpha: copy by copy, so that copies of several particles interleave; one particle is exact.
            if (std::string(blend) == "alpha") canvas.put(0, -400, 60, 10, {1, 1, 1}, 0.5f);
            const pictures::Image one = canvas.drawn(lookOf("sprites", {{"blend", blend}, {"clamped", "off"}}));
            const pictures::Image copies = canvas.drawn(
                lookOf("aa_sprites", {{"blend", blend}, {"clamped", "off"}, {"copies", "7"}, {"fade", fade}}));
            for (std::size_t p = 0; p < one.pixels.size(); ++p) expectNear(copies.pixels[p], one.pixels[p], 1e-5f);
            EXPECT_GT(at(sprite, 80, 60).g, 0.1f);
        }
}

TEST(SystemPicture, SpritesShowTheirPicture) {
    Canvas canvas(1);
    canvas.dust.radius[0] = 1;
    const pictures::Image gaussian = canvas.drawn(lookOf("sprites", {{"blend", "alpha"}}));
    const pictures::Image picture = canvas.drawn(lookOf("sprites", {{"blend", "alpha"}, {"picture", "puff"}}));
    EXPECT_NE(gaussian.pixels, picture.pixels);
    float a = 0, b = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        a += -std::log(1 - gaussian.pixels[i].a);
        b += -std::log(1 - picture.pixels[i].a);
    }
    EXPECT_NEAR(b / a, 1, 0.02) << "a picture keeps the puff's mass";
}

TEST(SystemPicture, AnObjectCoversTheDiscOfItsRadiusAndTheNearestHides) {
    Canvas canvas(2);
    const float radius = 20 * canvas.pixelMetres(10);
    canvas.put(0, 80, 60, 10, {1, 0, 0}, 1);
    canvas.put(1, 80, 60, 30, {0, 1, 0}, 1);
    canvas.dust.radius[0] = radius;
    canvas.dust.radius[1] = 0.5f * radius;
    const Look look = lookOf("objects");
    const auto covered = [&] {
        float sum = 0;
        for (const glm::vec4& pixel : canvas.drawn(look).pixels) {
            sum += pixel.a;
            EXPECT_EQ(pixel.g, 0) << "the background is visible";
        }
        return sum;
    };
    // The sphere is a polyhedron inside its ball, and its outline at 10 m is wider by 1/√(1 − (r/10)²).
    const float ratio = covered() / (static_cast<float>(std::numbers::pi) * 400);
    EXPECT_GT(ratio, 0.93f);
    EXPECT_LT(ratio, 1.02f / (1 - radius * radius / 100));
    canvas.setWall(5);
    EXPECT_EQ(covered(), 0);
    canvas.setWall(20);
    EXPECT_GT(covered(), 1100);
    canvas.dust.opacity[0] = 0.5f;
    EXPECT_NEAR(at(canvas.drawn(look), 80, 60).a, 0.5f, 1e-6f);
}

TEST(SystemPicture, SaysItsMemory) {
    Canvas canvas(100);
    SystemPicture shown(TestMoment::device(), lookOf("points", {{"stereo", "on"}}), canvas.scene.lights);
    shown.upload({canvas.dust, glm::vec3(0), 1.0f / 60}, StageClock());
    (void)canvas.picture([&](gpu::Layer& layer) { shown.draw(canvas.view, layer); });
    std::size_t primitives = 0, buffers = 0;
    for (const MemoryUse& use : shown.memory()) (use.structure == "primitives" ? primitives : buffers) += use.gpuBytes;
    EXPECT_GE(primitives, 100 * 32u);
    EXPECT_EQ(buffers, 3 * 160 * 120 * 16u);
    EXPECT_EQ(shown.count(), 200u);
}

}  // namespace
}  // namespace dustbench::plugin_particles

namespace dustbench::plugin_particles::brightness {
namespace {

TEST(Brightness, FollowsFromTheWayOfDrawing) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        std::map<std::string, Finding> found;
        for (const Finding& each : measureBrightness(draw::TestCanvas::device(), seed)) found[each.quantity] = each;
        EXPECT_EQ(found.size(), 8u);
        EXPECT_EQ(found["point_light_4x"].value, 1);
        // α·L/2 of a line of L pixels along the longer axis: 4, except for the pixel at its end.
        EXPECT_NEAR(found["line_light_4x"].value, 4, 0.3);
        // 10/2 + 1 pixels against 40/2 + 1, averaged over directions.
        EXPECT_GT(found["hybrid_light_4x"].value, 2.5);
        EXPECT_LT(found["hybrid_light_4x"].value, found["line_light_4x"].value);
        EXPECT_LT(found["shuffled_additive"].value, 1e-5);
        EXPECT_LT(found["shuffled_clamped"].value, 1e-5);
        EXPECT_GT(found["shuffled_alpha"].value, 0.1);
        EXPECT_EQ(found["contrast_white_additive"].value, 0);
        EXPECT_GT(found["contrast_white_alpha"].value, 0.3);
    }
}

}  // namespace
}  // namespace dustbench::plugin_particles::brightness
