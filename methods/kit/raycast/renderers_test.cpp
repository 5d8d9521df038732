// Tests the other renderers of a grid against the march, and the light volume.
#include <gtest/gtest.h>

#include "methods/kit/raycast/iso_surface.h"
#include "methods/kit/raycast/raycast_test_canvas.h"

namespace dustbench::raycast {
namespace {

TEST(Renderers, ShowByFineSlicesWhatTheMarchShows) {
    Canvas canvas;
    canvas.setWall(3.217, 50);
    for (const bool burning : {false, true})
        for (const glm::dvec3& eye : {glm::dvec3(3, 2, 4), glm::dvec3(0.3, 0.2, 0.1)}) {
            canvas.lookFrom(eye, -eye);
            RaycastSettings settings = settingsOf(Backend::gl);
            settings.extinctionPerMetre = 4;
            settings.shadowCells = 2;
            settings.asymmetry = 0.5f;
            settings.stepCells = 0.2;
            const pictures::Image march = canvas.picture(lumps(burning), settings);
            settings.renderer = Renderer::slices;
            const pictures::Image slices = canvas.picture(lumps(burning), settings);
            EXPECT_LT(maximumDifference(march, slices), 0.07) << eye.x;
            EXPECT_NEAR(meanAlpha(march) / meanAlpha(slices), 1, 2e-3);
        }
}

TEST(Renderers, ShowBySplatsAlmostWhatTheMarchShows) {
    Canvas canvas;
    canvas.setWall(4.2, 50);
    canvas.lookFrom({3, 2, 4}, {-3, -2, -4});
    for (const bool burning : {false, true}) {
        RaycastSettings settings = settingsOf(Backend::gl);
        settings.extinctionPerMetre = 2;
        settings.shadowCells = burning ? 1 : 0;
        const pictures::Image march = canvas.picture(lumps(burning), settings);
        settings.renderer = Renderer::splat;
        const pictures::Image splats = canvas.picture(lumps(burning), settings);
        double difference = 0, redOfMarch = 0, redOfSplats = 0;
        for (std::size_t i = 0; i < march.pixels.size(); ++i) {
            difference += static_cast<double>(std::abs(march.pixels[i].a - splats.pixels[i].a));
            redOfMarch += static_cast<double>(march.pixels[i].r);
            redOfSplats += static_cast<double>(splats.pixels[i].r);
        }
        // A splat is slightly wider than linear interpolation, and fire in part of a cell fills the whole cell.
        EXPECT_NEAR(meanAlpha(march) / meanAlpha(splats), 1, 0.04);
        EXPECT_NEAR(redOfMarch / redOfSplats, 1, burning ? 0.1 : 0.04);
        EXPECT_LT(difference / static_cast<double>(march.pixels.size()), 0.1 * meanAlpha(march));
    }
}

TEST(IsoSurface, OfABallIsThatBall) {
    const glm::dvec3 middle(0.2, -0.1, 0.3);
    const TestGrid ball({30, 28, 26}, 0.1, {-1.4, -1.5, -1.2},
                        [&](const glm::dvec3& at) { return std::max(0.0, 2 - glm::length(at - middle)); });
    const IsoSurface surface = isoSurface(ball.shown(), 1.2);  // a radius of 0.8
    ASSERT_GT(surface.indices.size(), 3000u);
    double area = 0;
    for (const IsoSurface::Vertex& vertex : surface.vertices) {
        const glm::dvec3 out = glm::dvec3(vertex.place) + ball.originMetres - middle;
        ASSERT_NEAR(glm::length(out), 0.8, 0.005);
        ASSERT_GT(glm::dot(glm::normalize(out), glm::dvec3(vertex.normal)), 0.99);
    }
    for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return glm::dvec3(surface.vertices[surface.indices[i + k]].place); };
        area += glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
    }
    EXPECT_NEAR(area / (4 * 3.14159265 * 0.64), 1, 0.01);
    EXPECT_TRUE(isoSurface(ball.shown(), 3).indices.empty());
}

TEST(Renderers, ShowAnIsosurfaceAsASolidThatTheSceneHides) {
    Canvas canvas;
    canvas.lights.toSun = {0, 0, 1};
    canvas.lookFrom({0, 0, 5}, {0, 0, -1});
    canvas.setWall(3.5, 48);  // in front of the ball's right half
    const TestGrid ball({20, 20, 20}, 0.2, {-2, -2, -2},
                        [](const glm::dvec3& at) { return 2 / (1 + glm::dot(at, at)); });
    RaycastSettings settings;
    settings.renderer = Renderer::isosurface;
    settings.isoDensity = 1;  // a radius of 1
    const pictures::Image image = canvas.picture(ball, settings);
    double covered = 0;
    for (const glm::vec4& pixel : image.pixels) covered += static_cast<double>(pixel.a);
    // Half a disc, whose rim is where the line of sight is tangent to the ball: tan² = 1/(25 − 1).
    const double pixelsPerSlope = 36 / std::tan(canvas.view.camera.verticalFieldOfView / 2);
    EXPECT_NEAR(covered / (3.14159265 / 48 * pixelsPerSlope * pixelsPerSlope), 1, 0.03);
    const float red = settings.smokeColour.r * (canvas.lights.ambient.r + canvas.lights.sun.r);
    EXPECT_NEAR(image.at(47, 36).r, red, 0.01);
    EXPECT_EQ(image.at(50, 36).a, 0);
}

TEST(LightVolume, OfAHomogeneousBoxIsTheAnalyticOne) {
    // Neither the cells nor the rows of texels are whole multiples.
    const TestGrid box({38, 10, 7}, 0.25, {3, 2, 1}, [](const glm::dvec3&) { return 0.8; });
    for (const glm::dvec3& toSun : {glm::dvec3(-0.48, 0.6, 0.64), glm::dvec3(0, 1, 0), glm::dvec3(0.6, -0.8, 0)}) {
        RaycastSettings settings;
        settings.shadowCells = 2;
        settings.extinctionPerMetre = 0.7;
        MemoryLedger ledger;
        LightVolume light(settings, glm::vec3(toSun), ledger);
        light.set(box.shown());
        ASSERT_EQ(light.texels(), glm::ivec3(19, 5, 4));
        for (int i = 0; i < 19 * 5 * 4; ++i) {
            const glm::dvec3 end = 0.25 * glm::dvec3(box.cells);
            const glm::dvec3 at = glm::min(0.5 * (glm::dvec3(i % 19, i / 19 % 5, i / 95) + 0.5), end);
            double length = 1e9;
            for (int axis = 0; axis < 3; ++axis)
                if (toSun[axis] != 0)
                    length = std::min(length, ((toSun[axis] > 0 ? end[axis] : 0) - at[axis]) / toSun[axis]);
            EXPECT_NEAR(light.values()[static_cast<std::size_t>(i)], std::exp(-0.56 * length), 1e-4) << i;
        }
    }
}

}  // namespace
}  // namespace dustbench::raycast
