// The car's wheel: tyre with a lettered side, dished rim and five spokes, which make its rotation visible.
#include <array>
#include <cmath>
#include <numbers>

#include "bench/world/car_model.h"
#include "bench/world/surface_builder.h"

namespace dustbench::world {
namespace {

using glm::vec3;

constexpr vec3 rubber{0.018f, 0.017f, 0.016f};
constexpr vec3 worn{0.040f, 0.037f, 0.034f};
constexpr vec3 tyreLetters{0.55f, 0.54f, 0.50f};
constexpr vec3 rimColour{0.62f, 0.62f, 0.60f};
constexpr vec3 dark{0.012f, 0.012f, 0.012f};

constexpr int segments = 36;
constexpr int spokes = 5;

}  // namespace

scene::Mesh carWheel(const scene::VehicleParameters& parameters) {
    const float radius = static_cast<float>(parameters.wheelRadiusMetres);
    const float half = static_cast<float>(parameters.wheelWidthMetres) / 2;
    SurfaceBuilder builder;

    // From the hub's outer face outwards over the tread to the inner face; the outside is to the left.
    const std::array<glm::vec2, 12> profile{{{0, 0.40f * half},
                                             {0.58f * radius, 0.25f * half},
                                             {0.60f * radius, 0.85f * half},
                                             {0.66f * radius, 0.90f * half},
                                             {0.70f * radius, 0.97f * half},
                                             {0.80f * radius, half},
                                             {0.93f * radius, 0.96f * half},
                                             {radius, 0.72f * half},
                                             {radius, -0.72f * half},
                                             {0.93f * radius, -0.96f * half},
                                             {0.64f * radius, -half},
                                             {0, -0.8f * half}}};
    builder.turned(profile, segments, [](int part, int segment) {
        if (part < 2 || part == 10) return dark;
        if (part == 2 || part == 3) return rimColour;
        if (part == 5 && segment % 12 < 4) return tyreLetters;
        if (part == 7 && segment % 2 == 0) return worn;
        return rubber;
    });

    const float outer = 0.62f * radius, inner = 0.10f * radius;
    const float face = 0.78f * half, back = 0.3f * half;
    for (int spoke = 0; spoke < spokes; ++spoke) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(spoke) / spokes;
        const vec3 along(std::cos(angle), std::sin(angle), 0), across(-along.y, along.x, 0);
        // Around the spoke's section: back, side, face, side, back.
        const auto position = [&](float u, float v) {
            const float wide = (u > 0.5f ? 0.085f : 0.15f) * radius;
            const vec3 middle = along * (u > 0.5f ? outer : inner);
            const bool right = v < 1.5f;
            const bool up = v > 0.5f && v < 2.5f;
            return middle + across * (right ? -wide : wide) + vec3(0, 0, up ? face : back);
        };
        builder.facets(std::array{0.0f, 1.0f}, std::array{0.0f, 1.0f, 2.0f, 3.0f}, position,
                       [](float, float) { return rimColour; });
    }
    const std::array<glm::vec2, 3> cap{
        {{0, 0.92f * half}, {0.13f * radius, 0.88f * half}, {0.16f * radius, 0.4f * half}}};
    builder.turned(cap, 10, [](int part, int) { return part == 0 ? dark : rimColour; });
    return builder.finish();
}

}  // namespace dustbench::world
