#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "methods/shared/draw/test_canvas.h"
#include "methods/shared/raycast/grid_raycast.h"
#include "methods/shared/raycast/raycast_test_grid.h"

namespace dustbench::raycast {
namespace {

class Canvas : public draw::TestCanvas {
 public:
    Canvas() : TestCanvas(96, 72, {0, 0, 12}, {0, 0, -1}) {}

    draw::Image picture(const TestGrid& grid, const RaycastSettings& settings) {
        MemoryLedger ledger;
        GridRaycast raycast(device(), settings, lights, ledger);
        raycast.upload(grid.shown());
        return TestCanvas::picture([&](const gpu::Layer& layer) { raycast.draw(view, layer); });
    }

    /// What is left of a ray between two corners: from the eye, and cut by the wall; in metres.
    [[nodiscard]] double lengthWithin(int x, int y, const glm::dvec3& least, const glm::dvec3& most) const {
        const glm::dvec3 along = glm::normalize(glm::dvec3(view.rayDirection(x + 0.5, y + 0.5)));
        const glm::dvec3 forward = glm::normalize(view.camera.target - view.camera.eye);
        double enter = 0, leave = wallAt(x) / glm::dot(along, forward);
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (least[axis] - view.camera.eye[axis]) / along[axis];
            const double b = (most[axis] - view.camera.eye[axis]) / along[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return std::max(leave - enter, 0.0);
    }

    scene::Lights lights;
};

class GridRaycastOn : public ::testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Backends, GridRaycastOn, ::testing::Values(Backend::cpu, Backend::gl),
                         [](const auto& test) { return test.param == Backend::cpu ? "Cpu" : "Gl"; });

/// Rays never end early.
RaycastSettings settingsOf(Backend backend) {
    RaycastSettings settings;
    settings.backend = backend;
    settings.stopAlpha = 1;
    return settings;
}

TEST_P(GridRaycastOn, ShowsAHomogeneousBoxAsTheAnalyticImage) {
    Canvas canvas;
    const TestGrid box({12, 7, 9}, 0.5, {-3, -2, -2}, [](const glm::dvec3&) { return 0.8; });
    const glm::dvec3 most = box.originMetres + box.spacingMetres * glm::dvec3(box.cells);
    RaycastSettings settings = settingsOf(GetParam());
    settings.extinctionPerMetre = 0.6;
    const auto red = static_cast<double>(cloudColour(settings.smokeColour, canvas.lights).r);
    struct Look {
        glm::dvec3 eye, along;
        std::optional<double> wall;
    };
    for (const Look& look : {Look{{0.3, 0.2, 9}, {0, 0, -1}, {}}, Look{{6, 4, 7}, {-6, -4, -7}, {}},
                             Look{{0.1, 0.2, 0.3}, {1, 0.3, 0.2}, {}}, Look{{0, 0, 2.55}, {0, 0, -1}, {}},
                             Look{{0.3, 0.2, 9}, {0, 0, -1}, 8.3}, Look{{0, 0, 1}, {0.2, 0.1, -1}, 1.234},
                             Look{{0, 0, 9}, {0, 0, 1}, {}}, Look{{0, 0, 9}, {0, 0, -1}, 5}}) {
        canvas.lookFrom(look.eye, look.along);
        canvas.setWall(look.wall, look.wall ? 40 : 0);
        const draw::Image image = canvas.picture(box, settings);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const double alpha = -std::expm1(-0.48 * canvas.lengthWithin(x, y, box.originMetres, most));
                ASSERT_NEAR(image.at(x, y).a, alpha, 1e-3) << x << ',' << y << " from " << look.eye.x;
                ASSERT_NEAR(image.at(x, y).r, alpha * red, 1e-3);
            }
    }
}

}  // namespace
}  // namespace dustbench::raycast
