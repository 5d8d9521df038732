// The benchmark scene of the ray caster and its peers: a plume of 128×64×64 cells at 800×600 pixels, with half a cell
// per step.
//
// Nothing occludes the plume. Threads: the OpenGL thread.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/raycast/grid_raycast.h"
#include "methods/kit/raycast/raycast_test_grid.h"

namespace dustbench::raycast {

inline const TestGrid& benchPlume() {
    static const TestGrid grid = testPlume();
    return grid;
}

/// From the side and above, at the distance where the grid's bounding sphere fills the image height at a field of view
/// of 30°.
inline draw::TestCanvas& benchCanvas() {
    static draw::TestCanvas one = [] {
        const glm::dvec3 aside = glm::normalize(glm::dvec3(-0.45, 0.35, 1));
        const double radius = 0.5 * glm::length(glm::dvec3(6.4, 3.2, 3.2)), fieldOfView = glm::radians(30.0);
        draw::TestCanvas made(800, 600, aside * (radius / std::sin(fieldOfView / 2)), -aside);
        made.view.camera.verticalFieldOfView = fieldOfView;
        return made;
    }();
    return one;
}

inline RaycastSettings benchSettings(Backend backend, bool skipEmpty) {
    RaycastSettings settings;
    settings.backend = backend;
    settings.skipEmpty = skipEmpty;
    settings.extinctionPerMetre = 3;
    return settings;
}

/// The reference picture: all others must match it within the tolerance of an early stop.
inline const pictures::Image& checkedPicture() {
    static const pictures::Image image = [] {
        MemoryLedger ledger;
        GridRaycast raycast(draw::TestCanvas::device(), benchSettings(Backend::gl, false), {}, ledger);
        raycast.upload(benchPlume().shown());
        return benchCanvas().picture([&](const gpu::Layer& layer) { raycast.draw(benchCanvas().view, layer); });
    }();
    return image;
}

/// Throws if a picture differs from the reference. `alphaAt` takes an index into its pixels.
template <typename AlphaAt>
void verifyPicture(benchmark::State& state, const AlphaAt& alphaAt) {
    double worst = 0, sum = 0;
    const std::vector<glm::vec4>& checked = checkedPicture().pixels;
    for (std::size_t i = 0; i < checked.size(); ++i) {
        worst = std::max(worst, static_cast<double>(std::abs(alphaAt(i) - checked[i].a)));
        sum += static_cast<double>(alphaAt(i));
    }
    if (worst > 0.01) throw std::logic_error("the picture is off by " + std::to_string(worst));
    state.counters["worst"] = worst;
    state.counters["mean_alpha"] = sum / static_cast<double>(checked.size());
}

}  // namespace dustbench::raycast
