#include "methods/plugin_particles/curve_pass.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "methods/kit/particles/part.h"
#include "methods/kit/particles/part_toml.h"
#include "methods/kit/particles/particle_system.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/plugin_particles/system_picture.h"

namespace dustbench::plugin_particles {
namespace {

using particles::Look;
using particles::NamedValues;

constexpr float stepSeconds = 1.0f / 16;

/// Positions by serial, newest first, recorded independently of the particles' indices in the store.
using Diary = std::map<std::uint64_t, std::vector<glm::vec3>>;

void note(Diary& diary, const Puffs& puffs) {
    for (std::size_t i = 0; i < puffs.size(); ++i) {
        std::vector<glm::vec3>& places = diary[puffs.serial[i]];
        places.insert(places.begin(), puffs.position(i));
    }
}

/// Bursts whose particles die one by one: the store grows and shrinks, and moves particles into the gaps.
constexpr const char* bursts = R"(
emission = { part = "bursts", count = 60, duration_seconds = 0.2, interval_seconds = 0.9 }
position = { part = "sphere", at = "place", place = [0, 50, 0], radius_metres = 1 }
velocity = { part = "random", speed = 3, variation = 2 }
colour = { part = "constant" }
size = { part = "constant", radius_metres = 0.1 }
life = [ { part = "lifetime", average_seconds = 0.6, variation_seconds = 0.5 } ]
force = [ { part = "gravity", acceleration = 9.8 } ]
)";

TEST(LastPositions, AreThoseOfTheSameParticleWhateverItsPlaceInTheStore) {
    constexpr std::size_t kept = 5;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        particles::ParticleSystem system(particles::partsFromText(bursts, "bursts.toml"), seed);
        LastPositions positions(kept);
        Diary diary;
        const scene::Scene scene;
        std::map<std::uint64_t, std::size_t> placesBefore;
        int checked = 0, moved = 0, births = 0;
        for (int step = 0; step < 200; ++step) {
            scene::SceneState state;
            state.timeSeconds = step * static_cast<double>(stepSeconds);
            system.update({scene, state, static_cast<double>(stepSeconds)});
            const Puffs puffs = system.store();
            positions.follow(puffs, stepSeconds);
            note(diary, puffs);
            std::map<std::uint64_t, std::size_t> places;
            for (std::size_t i = 0; i < puffs.size(); ++i) {
                places[puffs.serial[i]] = i;
                const auto before = placesBefore.find(puffs.serial[i]);
                moved += before != placesBefore.end() && before->second != i;
                births += before == placesBefore.end();
                const std::vector<glm::vec3>& known = diary.at(puffs.serial[i]);
                for (std::size_t k = 0; k < std::min(kept, known.size()); ++k, ++checked)
                    ASSERT_EQ(positions.at(i, k), known[k]) << "step " << step << ", " << k << " back, seed " << seed;
            }
            placesBefore = std::move(places);
        }
        EXPECT_GT(checked, 10'000) << seed;
        EXPECT_GT(moved, 100) << seed;
        EXPECT_GT(births, 300) << seed;
    }
}

Look curveLook(const char* part, const NamedValues& values) {
    return particles::makePartOf<particles::RenderPart>(particles::PartKind::render, part, values)->look();
}

/// One particle, 10 m before an eye that looks along −Z; coordinates across the picture in pixels from its middle.
class CurveCanvas : public TestMoment {
 public:
    static constexpr float distance = 10;

    CurveCanvas() : TestMoment(1, 160, 120, {0, 0, 0}, {0, 0, -1}) {
        dust.keepOneColour(false);
        dust.serial[0] = 7;
        dust.red[0] = dust.green[0] = dust.blue[0] = 1;
        dust.opacity[0] = 0.8f, dust.radius[0] = 0.1f, dust.age[0] = 100, dust.lifetime[0] = 200;
    }
    [[nodiscard]] float metres(float pixels) const { return pixels * distance / (view.eyeToClip()[1][1] * 60); }
    void put(const glm::vec2& pixels, const glm::vec2& velocity) {
        dust.x[0] = metres(pixels.x), dust.y[0] = metres(pixels.y), dust.z[0] = -distance;
        dust.velocityX[0] = metres(velocity.x), dust.velocityY[0] = metres(velocity.y), dust.velocityZ[0] = 0;
    }
    void upload(SystemPicture& shown) { shown.upload({dust, glm::vec3(0), stepSeconds}, StageClock()); }
    pictures::Image drawn(SystemPicture& shown) {
        return picture([&](gpu::Layer& layer) { shown.draw(view, layer); });
    }
};

/// Pixels from the middle of the picture, y upwards.
glm::vec2 placeOf(const pictures::Image& image, std::size_t pixel) {
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t column = pixel % width, row = pixel / width;
    return {static_cast<float>(column) + 0.5f - static_cast<float>(image.width) / 2,
            static_cast<float>(image.height) / 2 - static_cast<float>(row) - 0.5f};
}

/// A body thrown under a constant acceleration: its positions at the steps, and between them by the same formula. In
/// steps of Δt, v ← v + a·Δt, x ← x + v·Δt: x(−u) = x − u·v·Δt + u(u − 1)/2·a·Δt².
struct Throw {
    glm::vec2 place, velocity, acceleration;

    [[nodiscard]] glm::vec2 at(float stepsBack) const {
        return place - stepsBack * stepSeconds * velocity +
               0.5f * stepsBack * (stepsBack - 1) * stepSeconds * stepSeconds * acceleration;
    }
    [[nodiscard]] glm::vec2 velocityAt(float stepsBack) const {
        return velocity - stepsBack * stepSeconds * acceleration;
    }
};

/// Thrown such that within `steps` steps it moves by `way` and its path bends by `bend`/8, in pixels.
Throw thrownOver(int steps, const glm::vec2& place, const glm::vec2& way, const glm::vec2& bend) {
    const float seconds = static_cast<float>(steps) * stepSeconds;
    return {place, way / seconds, bend / (seconds * seconds)};
}

std::array<Throw, 3> throwsOver(int steps) {
    return {thrownOver(steps, {20, 10}, {60, -40}, {0, -90}), thrownOver(steps, {-30, -25}, {-80, 30}, {70, 80}),
            thrownOver(steps, {0, 30}, {60, 10}, {-30, -80})};
}

TEST(CurvePass, IsTheParabolaOfABodyUnderAConstantForce) {
    for (const int steps : {1, 2, 5})
        for (const Throw& thrown : throwsOver(steps)) {
            CurveCanvas canvas;
            SystemPicture shown(
                CurveCanvas::device(),
                curveLook("curves",
                          {{"blend", "alpha"}, {"fade", "off"}, {"pieces", "16"}, {"steps", std::to_string(steps)}}),
                {});
            for (int back = steps + 3; back >= 0; --back) {
                canvas.put(thrown.at(static_cast<float>(back)), thrown.velocityAt(static_cast<float>(back)));
                canvas.upload(shown);
            }
            const pictures::Image image = canvas.drawn(shown);
            // Every lit pixel is on the closed-form curve, and every point of the curve has a lit pixel. OpenGL omits
            // the last pixel of a line, so the oldest point may be a pixel and half a diagonal away.
            constexpr float lastPixel = 1.71f;
            const auto distanceTo = [&](const glm::vec2& pixel) {
                float nearest = 1e9f;
                for (int i = 0; i <= 400; ++i)
                    nearest = std::min(nearest, glm::length(thrown.at(static_cast<float>(i * steps) / 400) - pixel));
                return nearest;
            };
            std::vector<glm::vec2> lit;
            for (std::size_t p = 0; p < image.pixels.size(); ++p)
                if (image.pixels[p].a > 0) lit.push_back(placeOf(image, p));
            for (const glm::vec2& pixel : lit) EXPECT_LT(distanceTo(pixel), 1) << pixel.x << " " << pixel.y;
            for (int k = 0; k <= 20 * steps; ++k) {
                const glm::vec2 place = thrown.at(static_cast<float>(k) / 20);
                float nearest = 1e9f;
                for (const glm::vec2& pixel : lit) nearest = std::min(nearest, glm::length(pixel - place));
                EXPECT_LT(nearest, lastPixel) << k << " twentieths of a step back, steps: " << steps;
            }
        }
}

/// The line part draws the straight path of the last step; so does a curve of one piece.
TEST(CurvePass, IsTheLineWhenItHasOnePieceOrNothingBendsIt) {
    for (const char* pieces : {"1", "8"})
        for (const char* fade : {"on", "off"})
            for (const float age : {100.0f, 0.3f * stepSeconds}) {
                CurveCanvas canvas;
                SystemPicture curve(CurveCanvas::device(),
                                    curveLook("curves", {{"blend", "alpha"}, {"fade", fade}, {"pieces", pieces}}), {});
                SystemPicture line(CurveCanvas::device(), curveLook("lines", {{"blend", "alpha"}, {"fade", fade}}), {});
                canvas.put({25.3f, 11.7f}, {500, 310});
                canvas.dust.age[0] = age;
                canvas.upload(curve);
                canvas.upload(line);
                const pictures::Image a = canvas.drawn(curve), b = canvas.drawn(line);
                int lit = 0, different = 0;
                for (std::size_t p = 0; p < a.pixels.size(); ++p) {
                    lit += b.pixels[p].a > 0;
                    // The pixel at the end of a piece may belong to either of two adjacent pieces.
                    different += std::abs(a.pixels[p].a - b.pixels[p].a) > 0.02f;
                }
                EXPECT_GT(lit, age < 1 ? 5 : 20);
                EXPECT_LE(different, std::string(pieces) == "1" ? 0 : 2);
            }
}

/// ∫ α·(1 − s) ds over a path of L pixels is α·L/2.
TEST(CurvePass, FadesLinearlyToItsOldEndOverAllSteps) {
    for (const int steps : {1, 4}) {
        CurveCanvas canvas;
        SystemPicture shown(CurveCanvas::device(),
                            curveLook("curves", {{"blend", "alpha"}, {"steps", std::to_string(steps)}}), {});
        constexpr float pixelsPerStep = 20;
        for (int back = steps + 2; back >= 0; --back) {
            canvas.put({40.5f - pixelsPerStep * static_cast<float>(back), 0.5f}, {pixelsPerStep / stepSeconds, 0});
            canvas.upload(shown);
        }
        const pictures::Image image = canvas.drawn(shown);
        float sum = 0, before = 2;
        for (int x = 159; x >= 0; --x) {
            const float alpha = image.pixels[static_cast<std::size_t>(59 * 160 + x)].a;
            sum += alpha;
            if (alpha == 0) continue;
            EXPECT_LE(alpha, before + 1e-6f) << x;
            before = alpha;
        }
        EXPECT_NEAR(sum, 0.8f * pixelsPerStep * static_cast<float>(steps) / 2, 1.7f);  // a pixel at either end
        EXPECT_LT(before, 0.1f);
    }
}

TEST(CurvePass, BeginsWhereTheParticleWasBorn) {
    CurveCanvas canvas;
    SystemPicture shown(CurveCanvas::device(),
                        curveLook("curves", {{"blend", "alpha"}, {"fade", "off"}, {"steps", "6"}}), {});
    float lit = 0;
    for (int step = 0; step < 4; ++step) {
        // Born half a step before the first upload; 16 pixels a step.
        canvas.dust.age[0] = (0.5f + static_cast<float>(step)) * stepSeconds;
        canvas.put({16 * (0.5f + static_cast<float>(step)), 0.5f}, {16 / stepSeconds, 0});
        canvas.upload(shown);
        lit = 0;
        const pictures::Image image = canvas.drawn(shown);
        for (const glm::vec4& pixel : image.pixels) lit += pixel.a > 0 ? 1 : 0;
        EXPECT_NEAR(lit, 16 * (0.5f + static_cast<float>(step)), 1.5f) << step;
        EXPECT_EQ(image.pixels[59 * 160 + 77].a, 0) << "before its birth";
    }
}

TEST(CurvePass, SaysItsMemory) {
    CurveCanvas canvas;
    SystemPicture shown(CurveCanvas::device(), curveLook("curves", {{"steps", "3"}}), {});
    canvas.put({0, 0}, {1, 0});
    canvas.upload(shown);
    std::size_t remembered = 0;
    for (const MemoryUse& use : shown.memory())
        if (use.structure == "last positions") remembered += use.cpuBytes;
    EXPECT_GE(remembered, sizeof(std::uint64_t) + 5 * 3 * sizeof(float));
}

}  // namespace
}  // namespace dustbench::plugin_particles
