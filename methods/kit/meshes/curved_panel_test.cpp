#include "methods/kit/meshes/curved_panel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dustbench::meshes {
namespace {

scene::Panel panelOf(const glm::dvec2& curvature) {
    scene::Panel panel;
    panel.sizeMetres = {1.6, 0.9};
    panel.depthMetres = 0.06;
    panel.curvaturePerMetre = curvature;
    return panel;
}

const glm::dvec2 curvatures[] = {{0, 0}, {1, 0}, {-0.8, 0}, {0.6, 1.5}, {-0.9, -1.2}, {0.7, -1.1}};

glm::dvec3 anywhere(const scene::Panel& panel, std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    return {0.5 * panel.sizeMetres.x * any(random), 0.5 * panel.sizeMetres.y * any(random), 0.1 * any(random)};
}

TEST(CurvedPanel, APlaceIsOnTheNormalOfItsPointOfTheFace) {
    std::mt19937 random(1);
    for (const glm::dvec2& curvature : curvatures) {
        const scene::Panel panel = panelOf(curvature);
        for (int n = 0; n < 200; ++n) {
            const glm::dvec3 relief = anywhere(panel, random);
            const glm::dvec3 face = fromRelief(panel, {relief.x, relief.y, 0});
            EXPECT_DOUBLE_EQ(face.x, relief.x);
            EXPECT_DOUBLE_EQ(face.y, relief.y);
            EXPECT_NEAR(face.z, -0.5 * (curvature.x * relief.x * relief.x + curvature.y * relief.y * relief.y), 1e-15);
            // The distance from the face is least there: it grows to all sides.
            const glm::dvec3 place = fromRelief(panel, relief);
            EXPECT_NEAR(glm::distance(place, face), std::abs(relief.z), 1e-14);
            for (const auto& [dx, dy] : {std::pair(1e-4, 0.0), {-1e-4, 0.0}, {0.0, 1e-4}, {0.0, -1e-4}})
                EXPECT_GT(glm::distance(place, fromRelief(panel, {relief.x + dx, relief.y + dy, 0})),
                          std::abs(relief.z));
        }
    }
}

TEST(CurvedPanel, ThereAndBackIsTheSamePlace) {
    std::mt19937 random(2);
    for (const glm::dvec2& curvature : curvatures) {
        const scene::Panel panel = panelOf(curvature);
        for (int n = 0; n < 500; ++n) {
            const glm::dvec3 relief = anywhere(panel, random);
            EXPECT_LT(glm::distance(toRelief(panel, fromRelief(panel, relief)), relief), 1e-12);
        }
    }
}

TEST(CurvedPanel, AxesAreTheDerivatives) {
    std::mt19937 random(3);
    for (const glm::dvec2& curvature : curvatures) {
        const scene::Panel panel = panelOf(curvature);
        for (int n = 0; n < 100; ++n) {
            const glm::dvec3 relief = anywhere(panel, random);
            const glm::dmat3 axes = reliefAxes(panel, relief);
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 step(0);
                step[axis] = 1e-5;
                const glm::dvec3 change = (fromRelief(panel, relief + step) - fromRelief(panel, relief - step)) / 2e-5;
                EXPECT_LT(glm::distance(axes[axis], change), 1e-8);
            }
            EXPECT_NEAR(glm::length(axes[2]), 1, 1e-14);
            EXPECT_GT(glm::determinant(axes), 0);
        }
    }
}

TEST(CurvedPanel, TheBoxHoldsThePlateTightly) {
    for (const glm::dvec2& curvature : curvatures) {
        const scene::Panel panel = panelOf(curvature);
        const PlateBounds box = boundsOf(panel);
        glm::dvec3 low(1e9), high(-1e9);
        for (int x = 0; x <= 20; ++x)
            for (int y = 0; y <= 20; ++y)
                for (const double z : {-panel.depthMetres, 0.0}) {
                    const glm::dvec2 share(x / 20.0 - 0.5, y / 20.0 - 0.5);
                    const glm::dvec3 place = fromRelief(panel, {share * panel.sizeMetres, z});
                    low = glm::min(low, place);
                    high = glm::max(high, place);
                }
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(box.low[axis], low[axis] + 1e-12) << axis;
            EXPECT_GE(box.high[axis], high[axis] - 1e-12) << axis;
            EXPECT_LT(low[axis] - box.low[axis] + box.high[axis] - high[axis], 0.06) << axis;
        }
    }
}

}  // namespace
}  // namespace dustbench::meshes
