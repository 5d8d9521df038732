#include "methods/kit/draw/cubes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "methods/kit/draw/test_canvas.h"

namespace dustbench::draw {
namespace {

struct Cube {
    glm::vec3 centre;
    float edge, opticalDepth;
    glm::vec3 colour{1};
};

/// A canvas that looks along −z, unless turned, from an eye away from the origin.
class CubeCanvas : public TestCanvas {
 public:
    CubeCanvas() : TestCanvas(160, 120, {100.5, 2.25, -40.125}, {0, 0, -1}) {}

    pictures::Image draw(Cubes& cubes, const std::vector<Cube>& list, bool coloured = false) {
        const auto layout = Cubes::layout(coloured);
        const auto values = cubes.map(list.size(), layout);
        std::size_t next = 0;
        const auto put = [&](float value) { values[next++] = value; };
        for (const Cube& cube : list) {
            for (int i = 0; i < 3; ++i) put(cube.centre[i]);
            put(cube.edge);
            put(cube.opticalDepth);
            for (int i = 0; coloured && i < 3; ++i) put(cube.colour[i]);
        }
        cubes.unmap();
        return drawAgain(cubes);
    }
    pictures::Image drawAgain(Cubes& cubes) {
        return picture([&](const gpu::Layer& layer) { cubes.draw(view, colourOfAll, layer); });
    }

    /// The faces of one cube that a pixel's ray crosses, and whether an edge is so close that either result is
    /// acceptable.
    struct Crossing {
        int faces = 0;
        bool doubtful = false;
    };
    [[nodiscard]] Crossing crossing(const Cube& cube, int x, int y) const {
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const glm::dvec3 forward = glm::normalize(view.camera.target - view.camera.eye);
        const glm::dvec3 centre = glm::dvec3(cube.centre) - view.camera.eye;
        const double half = static_cast<double>(cube.edge) / 2;
        const double last = wallAt(x);
        Crossing crossing;
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-half, half}) {
                const double t = (centre[axis] + side) / ray[axis];
                if (!std::isfinite(t) || t <= 0) continue;
                const glm::dvec3 hit = t * ray - centre;
                const double u = std::abs(hit[(axis + 1) % 3]), v = std::abs(hit[(axis + 2) % 3]);
                const double along = t * glm::dot(ray, forward) / (1 + 1.0 / 1024);  // as in the depth test
                // Rasterisers round corners to 1/256 of a pixel, here 8e-3 wide at unit distance.
                const double fromEdge = std::max(u, v) - half, margin = 5e-5 * t / std::abs(ray[axis]);
                const double fromNear = along - view.camera.nearMetres, fromWall = last - along;
                if (fromEdge < margin && fromNear > -1e-5 && fromWall > -1e-5 &&
                    (fromEdge > -margin || fromNear < 1e-5 || fromWall < 1e-5))
                    crossing.doubtful = true;
                if (fromEdge < 0 && fromNear > 0 && fromWall > 0) ++crossing.faces;
            }
        return crossing;
    }

    glm::vec3 colourOfAll{0.5f, 0.25f, 0.125f};
};

double opacityOf(double depth) {
    return -std::expm1(-depth);
}

/// Compares every pixel with the same faces composited in double precision. Returns the number of pixels that are not
/// empty.
int expectFaces(const CubeCanvas& canvas, const pictures::Image& image, const std::vector<Cube>& farToNear,
                bool coloured) {
    int filled = 0, doubtful = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            glm::dvec4 expected(0);
            bool certain = true;
            for (const Cube& cube : farToNear) {
                const auto [faces, unsure] = canvas.crossing(cube, x, y);
                certain = certain && !unsure;
                const double alpha = opacityOf(static_cast<double>(cube.opticalDepth) / 2);
                const glm::dvec3 colour(coloured ? cube.colour : canvas.colourOfAll);
                for (int face = 0; face < faces; ++face)
                    expected = glm::dvec4(alpha * colour, alpha) + (1 - alpha) * expected;
            }
            if (!certain) {
                ++doubtful;
                continue;
            }
            filled += expected.a > 0;
            for (int i = 0; i < 4; ++i)
                if (std::abs(static_cast<double>(image.at(x, y)[i]) - expected[i]) > 2e-6) {
                    ADD_FAILURE() << x << ',' << y << " channel " << i << ": " << image.at(x, y)[i] << " instead of "
                                  << expected[i];
                    return filled;
                }
        }
    EXPECT_LT(doubtful, image.width * image.height / 20);
    return filled;
}

TEST(Cubes, SeenHeadOnAreAsOpaqueAsTheirDepth) {
    CubeCanvas canvas;
    Cubes cubes(CubeCanvas::device());
    for (const float depth : {1e-5f, 0.02f, 0.11f, 1.0f, 8.0f}) {
        const pictures::Image image = canvas.draw(cubes, {{canvas.at({0, 0, -10}), 2, depth}});
        const double expected = opacityOf(static_cast<double>(depth));
        EXPECT_NEAR(image.at(80, 60).a, expected, 2e-6 * expected + 1e-7) << depth;
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(image.at(80, 60)[i], canvas.colourOfAll[i] * image.at(80, 60).a, 1e-6);
        EXPECT_EQ(image.at(5, 5), glm::vec4(0));
    }
}

TEST(Cubes, TransmittancesOfCubesBehindEachOtherMultiply) {
    CubeCanvas canvas;
    Cubes cubes(CubeCanvas::device());
    const Cube far{canvas.at({0.3f, 0, -14}), 2, 0.7f}, near{canvas.at({0, 0.2f, -8}), 1, 0.4f};
    EXPECT_NEAR(canvas.draw(cubes, {far, near}).at(80, 60).a, opacityOf(1.1), 1e-6);
    const pictures::Image alone = canvas.draw(cubes, {near}), other = canvas.draw(cubes, {far});
    const pictures::Image both = canvas.draw(cubes, {far, near});
    for (std::size_t i = 0; i < both.pixels.size(); ++i)
        ASSERT_NEAR(both.pixels[i].a, 1 - (1 - alone.pixels[i].a) * (1 - other.pixels[i].a), 1e-6);
}

TEST(Cubes, NearOnesCoverFarOnes) {
    CubeCanvas canvas;
    Cubes cubes(CubeCanvas::device());
    const Cube red{canvas.at({0, 0, -14}), 2, 30, {1, 0, 0}}, green{canvas.at({0, 0, -8}), 1, 3, {0, 1, 0}};
    const glm::vec4 pixel = canvas.draw(cubes, {red, green}, true).at(80, 60);
    EXPECT_NEAR(pixel.g, opacityOf(3), 1e-6);
    EXPECT_NEAR(pixel.r, std::exp(-3.0), 1e-6);
}

TEST(Cubes, AreTheirFacesPutOverOneAnother) {
    CubeCanvas canvas;
    Cubes cubes(CubeCanvas::device());
    std::mt19937 random(7);
    std::uniform_real_distribution<float> wide(-1, 1), share(0, 1);
    int filled = 0;
    for (int round = 0; round < 12; ++round) {
        // Random direction; in odd rounds with a wall, in every third round all around the eye.
        canvas.view.camera.target =
            canvas.view.camera.eye + glm::dvec3(wide(random), 0.5f * wide(random), wide(random));
        canvas.setWall(round % 2 ? std::optional<double>(9) : std::nullopt, 80);
        const glm::vec3 forward(glm::normalize(canvas.view.camera.target - canvas.view.camera.eye));
        std::vector<Cube> list;
        for (int i = 0; i < 40; ++i) {
            const float spread = round % 3 == 2 ? 12 : 5;
            const glm::vec3 place = (round % 3 == 2 ? 0.0f : 11.0f) * forward +
                                    spread * glm::vec3(wide(random), wide(random), wide(random));
            list.push_back({canvas.at(place), std::exp2(std::floor(4 * share(random)) - 2), 2 * share(random),
                            glm::vec3(share(random), share(random), share(random))});
        }
        const glm::vec3 eye(canvas.view.camera.eye);
        std::ranges::sort(list, std::greater<>(),
                          [&](const Cube& cube) { return glm::dot(cube.centre - eye, cube.centre - eye); });
        for (const bool coloured : {false, true})
            filled += expectFaces(canvas, canvas.draw(cubes, list, coloured), list, coloured);
    }
    EXPECT_GT(filled, 20'000);
}

TEST(Cubes, FromWithinShowOneFace) {
    CubeCanvas canvas;
    Cubes cubes(CubeCanvas::device());
    const double half = opacityOf(0.8 / 2);
    for (const glm::vec3& centre :
         {glm::vec3(0), glm::vec3(0.9f, 0.9f, -0.9f), glm::vec3(-0.5f, 0.2f, 0.85f), glm::vec3(0, 0, -0.999f)}) {
        const pictures::Image image = canvas.draw(cubes, {{canvas.at(centre), 2, 0.8f}});
        // Only the face that the eye nearly touches may be clipped by the near plane.
        if (centre.z < 0.85f)
            for (const glm::vec4& pixel : image.pixels) ASSERT_NEAR(pixel.a, half, 1e-6);
        else
            expectFaces(canvas, image, {{canvas.at(centre), 2, 0.8f}}, false);
    }
}

TEST(Cubes, AreCutByTheNearPlaneNotBrokenByIt) {
    CubeCanvas canvas;
    canvas.view.camera.target = canvas.view.camera.eye + glm::dvec3(1, -0.7, -1.3);
    Cubes cubes(CubeCanvas::device());
    // Faces closer than the near plane's 0.1 m, corners behind the eye, and one cube entirely before the near plane.
    for (const Cube& cube : {Cube{canvas.at({1.05f, 0, 0}), 2, 1}, Cube{canvas.at({0.6f, -0.6f, -0.6f}), 1.1f, 2},
                             Cube{canvas.at({3, -2.03f, -3}), 4, 0.5f}, Cube{canvas.at({0.03f, 0, -0.03f}), 0.05f, 3}})
        expectFaces(canvas, canvas.draw(cubes, {cube}), {cube}, false);
    EXPECT_EQ(canvas.draw(cubes, {{canvas.at({-4, 0.7f, 2}), 1.5f, 1}}).pixels, canvas.draw(cubes, {}).pixels);
}

TEST(Cubes, AreHiddenBehindWhatIsSolid) {
    CubeCanvas canvas;
    Cubes cubes(CubeCanvas::device());
    const Cube cube{canvas.at({0, 0, -10}), 2, 0.8f};
    const pictures::Image free = canvas.draw(cubes, {cube});
    for (const double wall : {8.9, 10.0, 11.1}) {
        canvas.setWall(wall, 80);
        const pictures::Image image = canvas.draw(cubes, {cube});
        EXPECT_EQ(image.at(78, 60), free.at(78, 60));
        const double faces = wall > 11 ? 2 : wall > 9 ? 1 : 0;
        EXPECT_NEAR(image.at(82, 60).a, opacityOf(0.4 * faces), 1e-6) << wall;
    }
}

TEST(Cubes, OnTheGroundShowTheFaceThatLiesInIt) {
    CubeCanvas canvas;
    Cubes cubes(CubeCanvas::device());
    for (const glm::dvec3& along : {glm::dvec3(0.2, -0.15, -1), glm::dvec3(1, -0.5, 0.3), glm::dvec3(0.1, -1, 0.1)}) {
        canvas.view.camera.target = canvas.view.camera.eye + along;
        canvas.setGround(2.25);
        int filled = 0;
        for (const float edge : {0.25f, 1.0f, 2.0f})
            for (const double distance : {2.5, 5.0, 9.0}) {
                const glm::vec3 place(distance * glm::normalize(glm::dvec3(along.x, 0, along.z)));
                const Cube cube{canvas.at({place.x, edge / 2 - 2.25f, place.z}), edge, 0.8f};
                filled += expectFaces(canvas, canvas.draw(cubes, {cube}), {cube}, false);
            }
        EXPECT_GT(filled, 300);
    }
}

TEST(Cubes, DrawAllThereAreAndTheSameAgain) {
    CubeCanvas canvas;
    Cubes cubes(CubeCanvas::device());
    for (const std::size_t count : {0u, 1u, 31u, 32u, 33u, 64u, 1000u, 7u}) {
        const std::vector<Cube> list(count, Cube{canvas.at({0, 0, -10}), 2, 1.0f / 256});
        const pictures::Image image = canvas.draw(cubes, list);
        EXPECT_EQ(cubes.count(), count);
        EXPECT_NEAR(image.at(80, 60).a, opacityOf(static_cast<double>(count) / 256), 2e-5) << count;
        EXPECT_EQ(canvas.drawAgain(cubes).pixels, image.pixels);
    }
    EXPECT_GE(cubes.gpuBytes(), 1000u * 5 * sizeof(float));
}

TEST(Cubes, WithoutEdgeOrDepthLeaveNoTrace) {
    CubeCanvas canvas;
    Cubes cubes(CubeCanvas::device());
    const Cube seen{canvas.at({0, 0, -10}), 2, 0.5f};
    const pictures::Image alone = canvas.draw(cubes, {seen});
    EXPECT_EQ(canvas.draw(cubes, {seen, {canvas.at({0, 0, -5}), 0, 1}, {canvas.at({0, 0, -4}), 1, 0}}).pixels,
              alone.pixels);
}

}  // namespace
}  // namespace dustbench::draw
