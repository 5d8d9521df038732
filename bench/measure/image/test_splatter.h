// Test fixture: dust in closed form, seen by parallel rays, with one deliberate flaw at a time.
//
// A puff of radius r and optical depth τ adds τ·exp(−b²/2s²), s = r/2, to the depth of a pixel at distance b from its
// centre; α = 1 − exp(−Σ). The ground is a plane that cuts the rays of row y at depth (horizon − y)·slope.
// Units: pixels, along the rays too. Frame: as ScreenPrimitive.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bench/measure/image/picture.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::measure {

struct TestPuff {
    double x = 0, y = 0, depth = 0;
    double radius = 12;
    double tau = 0.7;
    int texture = -1;  ///< −1: none
};

/// How gradually a puff fades into the ground: `softness` 1 is exact, 0 a hard cut.
struct TestGround {
    double horizon = 0, slope = 1, softness = 1;
};

struct TestView {
    int width = 0, height = 0;
    std::optional<TestGround> ground;
};

/// Two random numbers in [0, 1).
inline std::array<double, 2> testUniform(std::uint32_t stream, std::uint64_t serial) {
    const auto uniform = maths::uniform4(7, stream, serial);
    return {static_cast<double>(uniform[0]), static_cast<double>(uniform[1])};
}

/// A sum of four waves, chosen by the texture's number, with mean 0; u, v in radii from the centre.
class TestTexture {
 public:
    explicit TestTexture(int number) {
        for (std::size_t i = 0; i < waves_.size(); ++i) {
            const auto [turn, phase] = testUniform(100 + static_cast<std::uint32_t>(number), i);
            const double angle = 2 * std::numbers::pi * turn, frequency = 5 + static_cast<double>(i);
            waves_[i] = {frequency * std::cos(angle), frequency * std::sin(angle), 2 * std::numbers::pi * phase};
        }
    }
    [[nodiscard]] double at(double u, double v) const {
        double sum = 0;
        for (const auto& [alongU, alongV, phase] : waves_) sum += std::cos(alongU * u + alongV * v + phase);
        return sum / 4;
    }

 private:
    std::array<std::array<double, 3>, 4> waves_;
};

/// The share of a puff in front of the ground: ½ [1 + erf((t₁ − t_c)/(√2 s))], the width of the fade times softness.
inline double testFade(const TestGround& ground, const TestPuff& puff, double y) {
    const double in = (ground.horizon - y) * ground.slope - puff.depth;
    if (ground.softness == 0) return in > 0 ? 1 : 0;
    return 0.5 * (1 + std::erf(in / (std::numbers::sqrt2 * puff.radius / 2 * ground.softness)));
}

/// Sum of the puffs' depths; also the extinction of a grid one cell deep.
inline Plane testDepth(const std::vector<TestPuff>& puffs, const TestView& view) {
    PlaneOf<double> depth(view.width, view.height);
    for (const TestPuff& puff : puffs) {
        const double s = puff.radius / 2, reach = 2 * puff.radius;
        const auto first = [&](double centre) { return std::max(0, static_cast<int>(centre - reach)); };
        const auto end = [&](double centre, int size) { return std::min(size, static_cast<int>(centre + reach) + 1); };
        const auto gauss = [&](double distance) { return std::exp(-distance * distance / (2 * s * s)); };
        const int x0 = first(puff.x), x1 = end(puff.x, view.width);
        std::vector<double> across;
        for (int x = x0; x < x1; ++x) across.push_back(gauss(x + 0.5 - puff.x));
        const TestTexture texture(std::max(puff.texture, 0));
        for (int y = first(puff.y); y < end(puff.y, view.height); ++y) {
            const double v = y + 0.5 - puff.y;
            const double row = puff.tau * gauss(v) * (view.ground ? testFade(*view.ground, puff, y + 0.5) : 1);
            for (int x = x0; x < x1; ++x) {
                const double u = x + 0.5 - puff.x;
                const double detail = puff.texture < 0 ? 1 : 1 + texture.at(u / puff.radius, v / puff.radius);
                depth.at(x, y) += row * across[static_cast<std::size_t>(x - x0)] * detail;
            }
        }
    }
    Plane result(view.width, view.height);
    result.values.assign(depth.values.begin(), depth.values.end());
    return result;
}

inline Plane testAlpha(const std::vector<TestPuff>& puffs, const TestView& view) {
    Plane alpha = testDepth(puffs, view);
    for (float& value : alpha.values) value = -std::expm1(-value);
    return alpha;
}

/// Brown dust over a scene of two gradients.
inline Picture testPicture(const Plane& alpha) {
    pictures::Image image{alpha.width, alpha.height, {}};
    for (int y = 0; y < alpha.height; ++y)
        for (int x = 0; x < alpha.width; ++x) {
            const float a = alpha.at(x, y), down = static_cast<float>(y) / static_cast<float>(alpha.height);
            const glm::vec3 scene(0.1f + 0.1f * down, 0.12f + 0.1f * down, 0.3f - 0.2f * down);
            image.pixels.emplace_back(a * glm::vec3(0.55f, 0.45f, 0.35f) + (1 - a) * scene, 1.0f);
        }
    return preparePicture(image, "a splatted picture");
}

inline std::vector<ScreenPrimitive> testPrimitives(const std::vector<TestPuff>& puffs) {
    std::vector<ScreenPrimitive> primitives;
    primitives.reserve(puffs.size());
    for (const TestPuff& puff : puffs) primitives.push_back({puff.x, puff.y, puff.radius});
    return primitives;
}

}  // namespace dustbench::measure
