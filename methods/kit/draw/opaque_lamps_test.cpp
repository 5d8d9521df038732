// Tests the light of lamps on the opaque scene against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "methods/contract/method.h"
#include "methods/kit/draw/opaque_scene.h"
#include "methods/kit/draw/opaque_test_scene.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::draw {
namespace {

glm::dvec3 lampRay(const scene::View& view, int x, int y) {
    return glm::dvec3(view.rayDirection(x + 0.5, y + 0.5));
}

/// Without sun and haze, a lamp adds light to the sky's in proportion to its irradiance over the ambient light.
scene::Scene underTheSkyAlone() {
    scene::Scene scene;
    scene.lights.sun = glm::vec3(0);
    scene.lights.ambient = glm::vec3(0.25f);
    scene.lights.hazePerMetre = 0;
    return scene;
}

TEST(OpaqueLamps, LampsLightTheGroundByLambertsLawAndTheirDistance) {
    // albedo·(A + ΣE) over albedo·A, at every pixel of the ground: E = I·h/d³.
    const scene::Scene scene = underTheSkyAlone();
    const glm::dvec3 away(7000, 0, -300);
    const std::vector<scene::PointLight> lamps{{away + glm::dvec3(1, 1.5, 0), {2, 1, 0.5f}},
                                               {away + glm::dvec3(-3, 0.4, 2), {0, 0.5f, 1}}};
    const scene::View view = test::viewFrom(away + glm::dvec3(0, 6, 8), away);
    OpaqueScene opaque(scene, TestCanvas::device(), view.width, view.height);
    opaque.draw({}, view);
    const pictures::Image dark = readBack(opaque.colour());
    opaque.draw({}, view, lamps);
    const pictures::Image lit = readBack(opaque.colour());
    int compared = 0;
    double brightest = 0;
    for (int y = 0; y < view.height; y += 7)
        for (int x = 0; x < view.width; x += 7) {
            const glm::dvec3 ray = lampRay(view, x, y);
            if (ray.y > -0.1) continue;
            const glm::dvec3 point = view.camera.eye - ray * (view.camera.eye.y / ray.y);
            glm::dvec3 expected(1);
            for (const scene::PointLight& lamp : lamps) {
                const double d = glm::distance(lamp.position, point);
                expected += glm::dvec3(lamp.intensity) * (lamp.position.y / (d * d * d)) / 0.25;
            }
            const glm::dvec3 found = glm::dvec3(lit.at(x, y)) / glm::dvec3(dark.at(x, y));
            // Two half floats: 2⁻¹¹ each.
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c] / expected[c], 1, 2e-3) << x << ", " << y;
            brightest = std::max(brightest, expected.r);
            ++compared;
        }
    EXPECT_GT(compared, 2000);
    EXPECT_GT(brightest, 4);
}

TEST(OpaqueLamps, LampsLightTheSidesThatFaceThem) {
    scene::Scene scene = underTheSkyAlone();
    scene.solids.push_back(test::boxSolid({-1, 0, -1}, {1, 2, 1}, {0.5f, 0.5f, 0.5f}));
    scene.solidPoses.resize(1);
    const scene::View view = test::viewFrom({4, 1, 9}, {0, 1, 0});
    const auto lit = [&](const glm::dvec3& at) {
        OpaqueScene opaque(scene, TestCanvas::device(), view.width, view.height);
        const scene::PointLight lamp{at, glm::vec3(3)};
        opaque.draw({}, view, {&lamp, 1});
        return readBack(opaque.colour());
    };
    OpaqueScene opaque(scene, TestCanvas::device(), view.width, view.height);
    opaque.draw({}, view);
    const pictures::Image dark = readBack(opaque.colour());
    const pictures::Image before = lit({0.3, 1, 3}), behind = lit({0, 1, -4});
    int compared = 0;
    for (int y = 0; y < view.height; y += 5)
        for (int x = 0; x < view.width; x += 5) {
            const glm::dvec3 ray = lampRay(view, x, y);
            const glm::dvec3 point = view.camera.eye + ray * ((1 - view.camera.eye.z) / ray.z);
            if (std::abs(point.x) > 0.95 || std::abs(point.y - 1) > 0.95) continue;
            EXPECT_EQ(behind.at(x, y), dark.at(x, y));
            const double d = glm::distance(glm::dvec3(0.3, 1, 3), point);
            const double grazing = 1 - glm::dot(-ray / glm::length(ray), glm::dvec3(0, 0, 1));
            const double mirrored = 0.1 * (0.04 + 0.96 * std::pow(grazing, 5));
            const double expected = 0.5 * 3 * 2 / (d * d * d) * (1 - mirrored);
            ASSERT_NEAR(static_cast<double>(before.at(x, y).g - dark.at(x, y).g), expected, 1e-3) << x << ", " << y;
            ++compared;
        }
    EXPECT_GT(compared, 300);
}

TEST(OpaqueLamps, WithoutLampsNothingIsDifferentAfterwards) {
    scene::Scene scene = test::underAHighSun();
    scene.vehicle = test::boxVehicle();
    const scene::SceneState state = test::vehicleAt(scene, 0, 0);
    const scene::View view = test::viewFrom({-6, 3, 5}, {1, 0.5, 0}, 160, 120);
    OpaqueScene opaque(scene, TestCanvas::device(), view.width, view.height);
    opaque.draw(state, view);
    const pictures::Image before = readBack(opaque.colour());
    const scene::PointLight lamp{{1, 2, 2}, glm::vec3(3)};
    opaque.draw(state, view, {&lamp, 1});
    EXPECT_NE(before.pixels, readBack(opaque.colour()).pixels);
    opaque.draw(state, view, {});
    EXPECT_EQ(before.pixels, readBack(opaque.colour()).pixels);
    const std::vector<scene::PointLight> many(maximumPointLights + 1);
    EXPECT_THROW(opaque.draw(state, view, many), std::invalid_argument);
    EXPECT_NO_THROW(opaque.draw(state, view, std::span(many).first(maximumPointLights)));
}

}  // namespace
}  // namespace dustbench::draw
