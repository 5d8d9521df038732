// Tests the filters between cells against their closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "methods/kit/raycast/raycast_test_canvas.h"

namespace dustbench::raycast {
namespace {

/// Closed forms of a filter's value at a position in cells, for a layer of cells with edges of 1.
double filtered(const TestGrid& layer, Filter filter, const glm::dvec2& place) {
    const auto at = [&](int x, int y) {
        const glm::ivec2 cell = glm::clamp(glm::ivec2(x, y), glm::ivec2(0), glm::ivec2(layer.cells) - 1);
        return static_cast<double>(layer.density[static_cast<std::size_t>(cell.x + layer.cells.x * cell.y)]);
    };
    if (filter == Filter::nearest) return at(static_cast<int>(place.x), static_cast<int>(place.y));
    const glm::dvec2 low = glm::floor(place - 0.5);
    double sum = 0;
    for (int j = -1; j <= 2; ++j)
        for (int i = -1; i <= 2; ++i) {
            const glm::dvec2 away = glm::abs(place - 0.5 - low - glm::dvec2(i, j));
            const auto weight = [&](double d) {
                if (filter == Filter::linear) return std::max(1 - d, 0.0);
                return d < 1 ? 2.0 / 3 - d * d + d * d * d / 2 : std::pow(std::max(2 - d, 0.0), 3) / 6;
            };
            sum += weight(away.x) * weight(away.y) * at(static_cast<int>(low.x) + i, static_cast<int>(low.y) + j);
        }
    return sum;
}

class FiltersOn : public ::testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Backends, FiltersOn, ::testing::Values(Backend::cpu, Backend::gl),
                         [](const auto& test) { return test.param == Backend::cpu ? "Cpu" : "Gl"; });

TEST_P(FiltersOn, ShowALayerOfCellsByTheirClosedForms) {
    Canvas canvas;
    canvas.view.camera.verticalFieldOfView = 0.05;  // each ray stays at one position of the layer
    canvas.lookFrom({0, 0, 200}, {0, 0, -1});
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0, 1);
    const TestGrid layer({12, 10, 1}, 1, {-6, -5, -0.5}, [&](const glm::dvec3&) { return share(random); });
    for (const Filter filter : {Filter::nearest, Filter::linear, Filter::cubic}) {
        RaycastSettings settings = settingsOf(GetParam());
        settings.filter = filter;
        const pictures::Image image = canvas.picture(layer, settings);
        int seen = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const glm::dvec3 along(canvas.view.rayDirection(x + 0.5, y + 0.5));
                const glm::dvec2 place = 200 / -along.z * glm::dvec2(along) + glm::dvec2(6, 5);
                const glm::dvec2 inCell = glm::fract(place);
                // The layer's front and back are half a cell away, and a ray crosses up to 0.03 of a cell meanwhile.
                if (place.x < 0 || place.y < 0 || place.x > 12 || place.y > 10 ||
                    glm::any(glm::lessThan(glm::min(inCell, 1.0 - inCell), glm::dvec2(0.02))))
                    continue;
                ++seen;
                const double alpha = -std::expm1(-filtered(layer, filter, place) / -along.z);
                ASSERT_NEAR(image.at(x, y).a, alpha, filter == Filter::nearest ? 1e-5 : 2e-3) << x << ',' << y;
            }
        EXPECT_GT(seen, 4000);
    }
}

}  // namespace
}  // namespace dustbench::raycast
