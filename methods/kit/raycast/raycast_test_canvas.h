// Renders grids for the ray caster's tests.
#pragma once

#include <algorithm>
#include <cmath>

#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/raycast/grid_raycast.h"
#include "methods/kit/raycast/raycast_test_grid.h"

namespace dustbench::raycast {

class Canvas : public draw::TestCanvas {
 public:
    Canvas() : TestCanvas(96, 72, {0, 0, 12}, {0, 0, -1}) {}

    pictures::Image picture(const TestGrid& grid, const RaycastSettings& settings) {
        MemoryLedger ledger;
        GridRaycast raycast(device(), settings, lights, ledger);
        raycast.upload(grid.shown());
        return TestCanvas::picture([&](const gpu::Layer& layer) { raycast.draw(view, layer); });
    }

    /// Length of a ray in metres between two corners, from the eye to the wall.
    [[nodiscard]] double lengthWithin(int x, int y, const glm::dvec3& minimum, const glm::dvec3& maximum) const {
        const glm::dvec3 along = glm::normalize(glm::dvec3(view.rayDirection(x + 0.5, y + 0.5)));
        const glm::dvec3 forward = glm::normalize(view.camera.target - view.camera.eye);
        double enter = 0, leave = wallAt(x) / glm::dot(along, forward);
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (minimum[axis] - view.camera.eye[axis]) / along[axis];
            const double b = (maximum[axis] - view.camera.eye[axis]) / along[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return std::max(leave - enter, 0.0);
    }

    scene::Lights lights;
};

/// Settings in which rays never end early.
inline RaycastSettings settingsOf(Backend backend) {
    RaycastSettings settings;
    settings.backend = backend;
    settings.stopAlpha = 1;
    return settings;
}

/// Lumps of smoke, clear air between them, and fire in some of them.
inline TestGrid lumps(bool burning) {
    TestGrid grid({40, 24, 32}, 0.125, {-2.5, -1.5, -2}, [](const glm::dvec3& at) {
        return std::max(0.0, std::sin(3 * at.x) * std::cos(4 * at.y + at.z) * std::sin(2.5 * at.z + 1) - 0.2);
    });
    if (burning)
        for (std::size_t i = 0; i < grid.density.size(); ++i)
            grid.reaction.push_back(std::clamp(1.5f * grid.density[i] - 0.3f, 0.0f, 1.0f));
    return grid;
}

inline double maximumDifference(const pictures::Image& a, const pictures::Image& b) {
    double maximum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int channel = 0; channel < 4; ++channel)
            maximum = std::max(maximum, static_cast<double>(std::abs(a.pixels[i][channel] - b.pixels[i][channel])));
    return maximum;
}

/// Number of pixels that differ by more than `tolerance` in any channel.
inline int pixelsApart(const pictures::Image& a, const pictures::Image& b, double tolerance) {
    int apart = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const glm::vec4 off = glm::abs(a.pixels[i] - b.pixels[i]);
        apart += glm::any(glm::greaterThan(off, glm::vec4(static_cast<float>(tolerance)))) ? 1 : 0;
    }
    return apart;
}

inline double meanAlpha(const pictures::Image& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image.pixels) sum += static_cast<double>(pixel.a);
    return sum / static_cast<double>(image.pixels.size());
}

}  // namespace dustbench::raycast
