// The benchmark scenes of the ray caster and its peers, at 800×600 pixels with half a cell per step: a plume of
// 128×64×64 cells, and a thin trail in a box of 512×128×512, most of which is empty.
//
// Nothing occludes them. Threads: the OpenGL thread.
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

enum class Shown { plume, trail };

inline const TestGrid& benchGrid(Shown shown = Shown::plume) {
    static const TestGrid plume = testPlume();
    if (shown == Shown::plume) return plume;
    static const TestGrid trail({512, 128, 512}, 0.05, {-12.8, -3.2, -12.8}, [](const glm::dvec3& at) {
        // An arc of lumps that rises and widens.
        const double turn = std::atan2(at.z, at.x) / 3.15;
        const double across = std::hypot(std::hypot(at.x, at.z) - 10, at.y - turn), radius = 0.5 + 0.3 * turn;
        const double lumps = std::sin(9 * at.x) * std::sin(9 * at.y) * std::sin(9 * at.z);
        return std::max(0.0, 1 - std::pow(across / radius, 2.0) + 0.4 * lumps);
    });
    return trail;
}

/// From the side and above, at the distance where the grid's bounding sphere fills the image height at a field of view
/// of 30°.
inline draw::TestCanvas& benchCanvas(Shown shown = Shown::plume) {
    const auto made = [](const TestGrid& grid) {
        const glm::dvec3 aside = glm::normalize(glm::dvec3(-0.45, 0.35, 1));
        const double radius = 0.5 * grid.spacingMetres * glm::length(glm::dvec3(grid.cells)),
                     fieldOfView = glm::radians(30.0);
        draw::TestCanvas canvas(800, 600, aside * (radius / std::sin(fieldOfView / 2)), -aside);
        canvas.view.camera.verticalFieldOfView = fieldOfView;
        return canvas;
    };
    static draw::TestCanvas plume = made(benchGrid(Shown::plume));
    if (shown == Shown::plume) return plume;
    static draw::TestCanvas trail = made(benchGrid(Shown::trail));
    return trail;
}

inline RaycastSettings benchSettings(Backend backend, bool skipEmpty) {
    RaycastSettings settings;
    settings.backend = backend;
    settings.skipEmpty = skipEmpty;
    settings.extinctionPerMetre = 3;
    return settings;
}

/// The reference picture: all others must match it within the tolerance of early termination.
inline const pictures::Image& checkedPicture(Shown shown = Shown::plume) {
    const auto made = [](Shown each) {
        MemoryLedger ledger;
        GridRaycast raycast(draw::TestCanvas::device(), benchSettings(Backend::gl, false), {}, ledger);
        raycast.upload(benchGrid(each).shown());
        draw::TestCanvas& canvas = benchCanvas(each);
        return canvas.picture([&](const gpu::Layer& layer) { raycast.draw(canvas.view, layer); });
    };
    static const pictures::Image plume = made(Shown::plume);
    if (shown == Shown::plume) return plume;
    static const pictures::Image trail = made(Shown::trail);
    return trail;
}

/// Throws if a picture differs from the reference. `alphaAt` takes an index into its pixels.
template <typename AlphaAt>
void verifyPicture(benchmark::State& state, const AlphaAt& alphaAt, Shown shown = Shown::plume) {
    double worst = 0, sum = 0;
    const std::vector<glm::vec4>& checked = checkedPicture(shown).pixels;
    for (std::size_t i = 0; i < checked.size(); ++i) {
        worst = std::max(worst, static_cast<double>(std::abs(alphaAt(i) - checked[i].a)));
        sum += static_cast<double>(alphaAt(i));
    }
    if (worst > 0.01) throw std::logic_error("the picture differs from the reference by " + std::to_string(worst));
    state.counters["worst"] = worst;
    state.counters["mean_alpha"] = sum / static_cast<double>(checked.size());
}

}  // namespace dustbench::raycast
