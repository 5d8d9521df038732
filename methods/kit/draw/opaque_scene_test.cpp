// The opaque scene against rays traced here. Over 400 lines: all tests share the rays, boxes and pictures below.
#include "methods/kit/draw/opaque_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "methods/kit/draw/opaque_test_scene.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::draw {
namespace {

struct Box {
    glm::dvec3 minimum, maximum;
    [[nodiscard]] Box grown(double by) const { return {minimum - by, maximum + by}; }
};

/// Distance along the ray to the box, if it is hit (slab test).
std::optional<double> hit(const Box& box, const glm::dvec3& from, const glm::dvec3& direction) {
    double enter = 0, leave = INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.minimum[axis] - from[axis]) / direction[axis];
        const double b = (box.maximum[axis] - from[axis]) / direction[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave) return std::nullopt;
    return enter;
}

struct Pictures {
    pictures::Image colour;
    std::vector<float> depths;  ///< rows from the bottom

    [[nodiscard]] double depthAt(int x, int y) const {
        return static_cast<double>(depths[static_cast<std::size_t>((colour.height - 1 - y) * colour.width + x)]);
    }
};

class OpaqueSceneTest : public testing::Test {
 protected:
    Pictures draw(const scene::Scene& scene, const scene::SceneState& state, const scene::View& view) {
        OpaqueScene opaque(scene, device_, view.width, view.height);
        opaque.draw(state, view);
        return {readBack(opaque.colour()), opaque.depth().readFloats()};
    }

    gpu::Device& device_ = TestCanvas::device();
};

glm::dvec3 rayOf(const scene::View& view, int x, int y) {
    return glm::dvec3(view.rayDirection(x + 0.5, y + 0.5));
}

/// near / distance along the camera's axis
double depthOf(const scene::View& view, const glm::dvec3& ray, double distance) {
    const glm::dvec3 axis = glm::normalize(view.camera.target - view.camera.eye);
    return view.camera.nearMetres / (distance * glm::dot(axis, ray));
}

/// Depth of the plane y = 0 at a place of the picture, in pixels.
double groundDepth(const scene::View& view, double x, double y) {
    const glm::dvec3 ray(view.rayDirection(x, y));
    return depthOf(view, ray, -view.camera.eye.y / ray.y);
}

/// GPUs place vertices in steps of 1/256 of a pixel, and triangles with them; llvmpipe interpolates exact places.
double groundTolerance(const gpu::Device& device, const scene::View& view, int x, int y) {
    const double expected = groundDepth(view, x + 0.5, y + 0.5);
    const double step = device.isSoftware() ? 0 : 1.0 / 256;
    return 1e-4 * expected + std::abs(groundDepth(view, x + 0.5, y + 0.5 + step) - expected);
}

float brightness(const glm::vec4& pixel) {
    return pixel.r + pixel.g + pixel.b;
}

TEST_F(OpaqueSceneTest, FlatGroundsDepthIsTheRaysDistanceToThePlane) {
    const scene::Scene scene = test::underAHighSun();
    for (const scene::View& view : {test::viewFrom({3, 1.7, 5}, {0, 1, 0}, 160, 120),
                                    test::viewFrom({-500.3, 40, 7000.7}, {-480, 10, 6950}, 160, 120),
                                    test::viewFrom({0.2, 0.4, 0.1}, {9, 0.4, 2}, 160, 120)}) {
        const Pictures got = draw(scene, {}, view);
        int checked = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const glm::dvec3 ray = rayOf(view, x, y);
                const double distance = -view.camera.eye.y / ray.y;
                if (ray.y > 0) {
                    EXPECT_EQ(got.depthAt(x, y), 0);  // sky: infinitely far
                } else if (distance < 20e3) {
                    const double expected = depthOf(view, ray, distance);
                    EXPECT_NEAR(got.depthAt(x, y), expected, groundTolerance(device_, view, x, y)) << x << ", " << y;
                    ++checked;
                }
            }
        EXPECT_GT(checked, 160 * 120 / 4);
    }
}

TEST_F(OpaqueSceneTest, ReliefsDepthIsTheRaysDistanceToTheTerrain) {
    scene::Scene scene = test::underAHighSun();
    scene.terrain = test::dunes(129, 2.0f);
    const scene::View view = test::viewFrom({4, 9, 11}, {0, 1, 0}, 80, 60);
    const Pictures got = draw(scene, {}, view);
    for (int y = 30; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec3 ray = rayOf(view, x, y);
            const glm::dvec3 axis = glm::normalize(view.camera.target - view.camera.eye);
            const double distance = view.camera.nearMetres / (got.depthAt(x, y) * glm::dot(axis, ray));
            if (distance > 30) continue;
            const glm::dvec3 place = view.camera.eye + distance * ray;
            EXPECT_NEAR(place.y, scene.terrain.heightAt(static_cast<float>(place.x), static_cast<float>(place.z)),
                        0.02);
        }
}

TEST_F(OpaqueSceneTest, DrawsTheSameInASizeThatItIsGivenLater) {
    scene::Scene scene = test::underAHighSun();
    scene.vehicle = test::boxVehicle();
    scene.solids = {test::boxSolid({-2, 0, -1}, {1, 2.5, 1.5}, {0.9f, 0.1f, 0.9f})};
    scene.solidPoses.resize(1);
    const scene::SceneState state = test::vehicleAt(scene, 5, 1);
    const scene::View small = test::viewFrom({5, 3, 8}, {0, 1, 0}, 48, 36);
    const scene::View large = test::viewFrom({5, 3, 8}, {0, 1, 0}, 161, 120);
    OpaqueScene opaque(scene, device_, small.width, small.height);
    for (const scene::View& view : {large, small, large}) {
        opaque.resize(view.width, view.height);
        opaque.draw(state, view);
        const Pictures expected = draw(scene, state, view);
        EXPECT_EQ(readBack(opaque.colour()).pixels, expected.colour.pixels);
        EXPECT_EQ(opaque.depth().readFloats(), expected.depths);
    }
}

TEST_F(OpaqueSceneTest, BoxHidesWhatIsBehindIt) {
    scene::Scene scene = test::underAHighSun();
    const Box box{{-2, 0, -1}, {1, 2.5, 1.5}};
    scene.solids = {test::boxSolid(glm::vec3(box.minimum), glm::vec3(box.maximum), {0.9f, 0.1f, 0.9f})};
    scene.solidPoses.resize(1);
    const scene::View view = test::viewFrom({5, 3, 8}, {0, 1, 0}, 160, 120);
    const Pictures got = draw(scene, {}, view);
    int inside = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec3 ray = rayOf(view, x, y);
            const auto smaller = hit(box.grown(-0.05), view.camera.eye, ray);
            const glm::vec4 colour = got.colour.at(x, y);
            if (smaller) {
                const double expected = depthOf(view, ray, *hit(box, view.camera.eye, ray));
                EXPECT_NEAR(got.depthAt(x, y), expected, 1e-4 * expected);
                EXPECT_GT(colour.r, colour.g);
                ++inside;
            } else if (!hit(box.grown(0.05), view.camera.eye, ray) && ray.y < 0) {
                const double expected = groundDepth(view, x + 0.5, y + 0.5);
                EXPECT_NEAR(got.depthAt(x, y), expected, groundTolerance(device_, view, x, y));
            }
        }
    EXPECT_GT(inside, 500);
}

TEST_F(OpaqueSceneTest, GroundIsDarkWhereTheRayToTheSunHitsABox) {
    scene::Scene bare = test::underAHighSun(), withBox = bare;
    const Box box{{-2, 0, -1}, {1, 2.5, 1.5}};
    withBox.solids = {test::boxSolid(glm::vec3(box.minimum), glm::vec3(box.maximum), {0.5f, 0.5f, 0.5f})};
    withBox.solidPoses.resize(1);
    const glm::dvec3 toSun = glm::normalize(glm::dvec3(bare.lights.toSun));
    const scene::View view = test::viewFrom({-9, 7, -6}, {-1, 0, -1}, 160, 120);
    const Pictures lit = draw(bare, {}, view), shaded = draw(withBox, {}, view);
    int dark = 0, bright = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec3 ray = rayOf(view, x, y);
            if (ray.y >= 0 || hit(box.grown(0.1), view.camera.eye, ray)) continue;
            const glm::dvec3 place = view.camera.eye - view.camera.eye.y / ray.y * ray;
            const float share = brightness(shaded.colour.at(x, y)) / brightness(lit.colour.at(x, y));
            if (hit(box.grown(-0.25), place, toSun)) {
                EXPECT_LT(share, 0.6f) << x << ", " << y;
                ++dark;
            } else if (!hit(box.grown(0.25), place, toSun)) {
                EXPECT_NEAR(share, 1, 0.02f) << x << ", " << y;
                ++bright;
            }
        }
    EXPECT_GT(dark, 300);
    EXPECT_GT(bright, 3000);
}

TEST_F(OpaqueSceneTest, EveryPieceOfALongMeshThrowsItsShadow) {
    // One solid of 1.2 km: posts 30 m apart and 5 m across.
    scene::Scene bare = test::underAHighSun(), withPosts = bare;
    auto posts = std::make_shared<scene::Mesh>();
    for (int n = 0; n < 40; ++n)
        posts->append(test::box({30.0f * static_cast<float>(n) - 1, 0, -1}, {30.0f * static_cast<float>(n) + 1, 3, 1},
                                {0.5f, 0.5f, 0.5f}),
                      glm::mat4(1));
    withPosts.solids = {{"posts", posts}};
    withPosts.solidPoses.resize(1);
    const glm::dvec3 toSun = glm::normalize(glm::dvec3(bare.lights.toSun));
    for (const double at : {0.0, 600.0, 1170.0}) {
        const glm::dvec3 shadow = glm::dvec3(at, 2, 0) - toSun * (2 / toSun.y);  // shadow of a point within the post
        const scene::View view = test::viewFrom(shadow + glm::dvec3(-4, 5, -3), shadow, 81, 61);
        const float share = brightness(draw(withPosts, {}, view).colour.at(40, 30)) /
                            brightness(draw(bare, {}, view).colour.at(40, 30));
        EXPECT_LT(share, 0.6f) << at;
    }
}

TEST_F(OpaqueSceneTest, VehicleThrowsItsShadowWhereverItStands) {
    scene::Scene scene = test::underAHighSun();
    scene.vehicle = test::boxVehicle();
    const glm::dvec3 toSun = glm::normalize(glm::dvec3(scene.lights.toSun));
    for (const double at : {0.0, 37.3, 7000.2}) {
        const scene::SceneState here = test::vehicleAt(scene, at, 2.5), away = test::vehicleAt(scene, at + 400, 2.5);
        const Box box{here.vehicle.position + glm::dvec3(-0.8, 0.3, -0.85),
                      here.vehicle.position + glm::dvec3(3.4, 0.9, 0.85)};
        const Box all{here.vehicle.position + glm::dvec3(-0.8, 0, -0.87),
                      here.vehicle.position + glm::dvec3(3.4, 1.45, 0.87)};
        const scene::View view = test::viewFrom(here.vehicle.position + glm::dvec3(-5, 6, -7),
                                                here.vehicle.position + glm::dvec3(0.5, 0, -1), 160, 120);
        const Pictures with = draw(scene, here, view), without = draw(scene, away, view);
        int dark = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const glm::dvec3 ray = rayOf(view, x, y);
                if (ray.y >= 0 || hit(all.grown(0.1), view.camera.eye, ray)) continue;
                const glm::dvec3 place = view.camera.eye - view.camera.eye.y / ray.y * ray;
                const float share = brightness(with.colour.at(x, y)) / brightness(without.colour.at(x, y));
                if (hit(box.grown(-0.05), place, toSun)) {
                    EXPECT_LT(share, 0.6f) << x << ", " << y;
                    ++dark;
                } else if (!hit(all.grown(0.05), place, toSun) && !hit(all.grown(0.8), place, {1e-9, 1, 1e-9})) {
                    EXPECT_NEAR(share, 1, 0.02f) << x << ", " << y;  // a different triangle: the texture coordinates'
                                                                     // last bits may differ
                }
            }
        EXPECT_GT(dark, 100);
    }
}

TEST_F(OpaqueSceneTest, SunIsTheBrightestPixelAndStandsWhereTheLightsSay) {
    const scene::Scene scene = test::underAHighSun();
    const glm::dvec3 toSun = glm::normalize(glm::dvec3(scene.lights.toSun));
    const scene::View view = test::viewFrom({0, 2, 0}, glm::dvec3(0, 2, 0) + toSun, 201, 151);
    const pictures::Image got = draw(scene, {}, view).colour;
    EXPECT_GT(brightness(got.at(100, 75)), 20);
    EXPECT_LT(brightness(got.at(110, 75)), 3);
    EXPECT_LT(brightness(got.at(20, 20)), brightness(got.at(90, 75)));
}

TEST_F(OpaqueSceneTest, SameStateGivesTheSameBits) {
    scene::Scene scene = test::underAHighSun();
    scene.vehicle = test::boxVehicle();
    scene.solids = {test::boxSolid({-1, 0, -1}, {1, 1, 1}, {0.5f, 0.5f, 0.5f})};
    scene.solidPoses.resize(1);
    scene.solidPoses[0].toWorld[3] = glm::vec4(-4, 0, -3, 1);
    for (const bool relief : {false, true}) {
        if (relief) scene.terrain = test::dunes(65, 2.0f);
        const scene::SceneState state = test::vehicleAt(scene, 3, 1);
        const scene::View view = test::viewFrom({11, 5, 12}, {-2, 1, 0}, 160, 120);
        OpaqueScene opaque(scene, device_, 160, 120);
        opaque.draw(state, view);
        const pictures::Image first = readBack(opaque.colour());
        const std::vector<float> firstDepth = opaque.depth().readFloats();
        opaque.draw(test::vehicleAt(scene, -40, 9), test::viewFrom({500, 9, 30}, {0, 0, 0}, 160, 120));
        opaque.draw(state, view);
        EXPECT_TRUE(readBack(opaque.colour()).pixels == first.pixels);
        EXPECT_TRUE(opaque.depth().readFloats() == firstDepth);
        const Pictures again = draw(scene, state, view);
        EXPECT_TRUE(again.colour.pixels == first.pixels);
    }
}

TEST_F(OpaqueSceneTest, EveryPixelIsCoveredAndOpaque) {
    scene::Scene scene = test::underAHighSun();
    scene.vehicle = test::boxVehicle();
    for (const glm::dvec3& eye : {glm::dvec3(9, 0.3, 4), glm::dvec3(0, 300, 1), glm::dvec3(-40, 3, 0)}) {
        const pictures::Image got =
            draw(scene, test::vehicleAt(scene, 0, 0), test::viewFrom(eye, {0, 1, 0}, 97, 61)).colour;
        for (const glm::vec4& pixel : got.pixels) {
            EXPECT_EQ(pixel.a, 1);
            EXPECT_GT(brightness(pixel), 0.01f);
        }
    }
}

TEST_F(OpaqueSceneTest, HiddenSceneryLeavesTheHorizonsColourWithNothingInFrontOfIt) {
    scene::Scene scene = test::underAHighSun();
    scene.lights.skyHorizon = {0.25f, 0.5f, 0.125f};
    OpaqueScene opaque(scene, device_, 97, 61, ScenePanels::flat, Scenery::hidden);
    opaque.draw({}, test::viewFrom({9, 0.3, 4}, {0, 1, 0}, 97, 61));
    EXPECT_EQ(device_.ledger().totalBytes(), 97u * 61u * (8 + 4)) << "colour and depth alone";
    for (const glm::vec4& pixel : readBack(opaque.colour()).pixels) EXPECT_EQ(pixel, glm::vec4(0.25f, 0.5f, 0.125f, 1));
    for (const float depth : opaque.depth().readFloats()) EXPECT_EQ(depth, 0);
}

TEST_F(OpaqueSceneTest, LooksTheSameSevenKilometresOn) {
    scene::Scene scene = test::underAHighSun();
    scene.vehicle = test::boxVehicle();
    constexpr double far = 28 * 256;  // a whole number of the ground's tiles
    const auto drawAt = [&](double x) {
        return draw(scene, test::vehicleAt(scene, x, 0), test::viewFrom({x + 8, 3.2, 12}, {x - 6, 0.9, 0}, 320, 240));
    };
    const Pictures here = drawAt(0), there = drawAt(far);
    double sum = 0;
    int different = 0;
    for (std::size_t i = 0; i < here.colour.pixels.size(); ++i) {
        const glm::vec4 off = glm::abs(here.colour.pixels[i] - there.colour.pixels[i]);
        const float maximum = std::max({off.r, off.g, off.b});
        sum += static_cast<double>(maximum);
        different += maximum > 0.01f ? 1 : 0;
        EXPECT_NEAR(here.depths[i], there.depths[i], 1e-2f);
    }
    EXPECT_LT(sum / 76800, 5e-4);
    EXPECT_LT(different, 76800 / 500);  // outlines, where a pixel's centre falls on the other side
}

TEST_F(OpaqueSceneTest, BooksEverythingOnTheLedger) {
    scene::Scene scene = test::underAHighSun();
    scene.vehicle = test::boxVehicle();
    {
        const OpaqueScene opaque(scene, device_, 640, 480);
        std::size_t colour = 0;
        for (const auto& [name, bytes] : device_.ledger().entries()) {
            EXPECT_FALSE(name.empty());
            if (name == "scene colour") colour = bytes;
        }
        EXPECT_EQ(colour, 640u * 480u * 8u);
    }
    EXPECT_EQ(device_.ledger().totalBytes(), 0u);
}

TEST_F(OpaqueSceneTest, RefusesAViewOfAnotherSizeAndSolidsWithoutPoses) {
    scene::Scene scene = test::underAHighSun();
    OpaqueScene opaque(scene, device_, 64, 48);
    EXPECT_THROW(opaque.draw({}, test::viewFrom({1, 2, 3}, {0, 0, 0}, 48, 64)), std::invalid_argument);
    scene.solids = {test::boxSolid({0, 0, 0}, {1, 1, 1}, {1, 1, 1})};
    EXPECT_THROW(OpaqueScene(scene, device_, 64, 48), std::invalid_argument);
}

scene::Scene withPanel() {
    scene::Scene scene = test::underAHighSun();
    auto relief = std::make_shared<scene::Relief>();
    relief->columns = 2;
    relief->rows = 2;
    relief->depth.assign(4, 0.5f);
    relief->colour = {{0.8f, 0.1f, 0.1f}, {0.1f, 0.8f, 0.1f}, {0.1f, 0.1f, 0.8f}, {0.8f, 0.8f, 0.1f}};
    scene::Panel panel;
    panel.name = "board";
    panel.sizeMetres = {2, 2};
    panel.depthMetres = 0.1;
    panel.toParent[3] = {0, 1.5, 0, 1};
    panel.relief = relief;
    scene.panels.push_back(panel);
    return scene;
}

TEST_F(OpaqueSceneTest, PanelsShowTheirColoursWithTheFirstRowBelow) {
    const scene::Scene scene = withPanel();
    const scene::View view = test::viewFrom({0, 1.5, 4}, {0, 1.5, 0}, 160, 120);
    const Pictures got = draw(scene, {}, view);
    const auto strongest = [&](int x, int y) {
        const glm::vec4& pixel = got.colour.at(x, y);
        return pixel.r > pixel.g && pixel.r > pixel.b ? 'r' : pixel.g > pixel.b ? 'g' : 'b';
    };
    EXPECT_EQ(strongest(62, 78), 'r');  // lower left
    EXPECT_EQ(strongest(98, 78), 'g');
    EXPECT_EQ(strongest(62, 42), 'b');
    EXPECT_GT(std::min(got.colour.at(98, 42).r, got.colour.at(98, 42).g), 2 * got.colour.at(98, 42).b);  // yellow
    const glm::dvec3 ray = rayOf(view, 80, 60);
    EXPECT_NEAR(got.depthAt(80, 60), depthOf(view, ray, -4 / ray.z), 1e-5);
}

TEST_F(OpaqueSceneTest, HiddenPanelsAreNotSeenButCastShadows) {
    const scene::Scene scene = withPanel();
    scene::Scene bare = scene;
    bare.panels.clear();
    const scene::View view = test::viewFrom({6, 5, 8}, {-0.7, 0, -0.7}, 160, 120);
    OpaqueScene hidden(scene, device_, 160, 120, ScenePanels::hidden);
    hidden.draw({}, view);
    const pictures::Image with = readBack(hidden.colour());
    const Pictures without = draw(bare, {}, view), flat = draw(scene, {}, view);
    EXPECT_EQ(hidden.depth().readFloats(), without.depths);
    EXPECT_NE(flat.depths, without.depths);
    int darker = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x)
            darker += brightness(with.at(x, y)) < 0.8f * brightness(without.colour.at(x, y)) ? 1 : 0;
    EXPECT_GT(darker, 100);
}

TEST_F(OpaqueSceneTest, AVehiclesPanelGoesAlongWithIt) {
    scene::Scene scene = withPanel();
    scene.vehicle = test::boxVehicle();
    scene.panels[0].parent = scene::Panel::Parent::vehicle;
    scene.panels[0].toParent[3] = {1.5, 2.5, 0, 1};
    for (const double x : {0.0, 37.0}) {
        const scene::SceneState state = test::vehicleAt(scene, x, 2);
        const scene::View view = test::viewFrom({x + 1.5, 2.5, 6}, {x + 1.5, 2.5, 2}, 160, 120);
        const Pictures got = draw(scene, state, view);
        EXPECT_GT(got.colour.at(62, 78).r, 2 * got.colour.at(62, 78).g) << x;
        const glm::dvec3 ray = rayOf(view, 80, 60);
        EXPECT_NEAR(got.depthAt(80, 60), depthOf(view, ray, -4 / ray.z), 1e-5) << x;
    }
}

}  // namespace
}  // namespace dustbench::draw
