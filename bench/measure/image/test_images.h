// Test fixture: pictures defined by a formula, so that other programs can be given identical ones.
//
// Frame: x to the right, y down, both from 0 at the first pixel; c is the channel, 0..2. Values are linear light.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bench/measure/image/picture.h"

namespace dustbench::measure {

using Formula = std::function<double(int x, int y, int c)>;

inline pictures::Image imageOf(int width, int height, const Formula& formula) {
    pictures::Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.pixels.emplace_back(static_cast<float>(formula(x, y, 0)), static_cast<float>(formula(x, y, 1)),
                                      static_cast<float>(formula(x, y, 2)), 1.0f);
    return image;
}

inline Picture pictureOf(int width, int height, const Formula& formula, const std::string& name = "a test image") {
    return preparePicture(imageOf(width, height, formula), name);
}

inline Plane planeOf(int width, int height, const std::function<double(int x, int y)>& formula) {
    Plane plane(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) plane.at(x, y) = static_cast<float>(formula(x, y));
    return plane;
}

/// Two pictures of 120×90 pixels.
struct TestPair {
    Formula reference, image;
};
inline constexpr int pairWidth = 120, pairHeight = 90;

/// Smooth waves. `image` is paler, with a tint in the lower part, a brighter box and dark stripes one pixel wide.
inline TestPair waves() {
    const auto wave = [](int x, int y, int c) {
        return 0.5 + 0.4 * std::sin(0.13 * x + 0.5 * c) * std::cos(0.09 * y - 0.3 * c);
    };
    return {wave, [wave](int x, int y, int c) {
                if (x >= 80 && x % 4 == 0) return 0.1;
                const bool box = x >= 30 && x < 60 && y >= 20 && y < 50;
                return 0.9 * wave(x, y, c) + (y >= 45 ? 0.05 * c : 0) + (box ? 0.1 : 0);
            }};
}

/// A checkerboard with fields of 8 pixels; `image` is shifted by one pixel.
inline TestPair checkers() {
    const auto board = [](int shift) {
        return [shift](int x, int y, int c) { return ((x + shift) / 8 + y / 8) % 2 == 0 ? 0.8 : 0.05 + 0.1 * c; };
    };
    return {board(0), board(1)};
}

/// All green; the right half of `image` is blue. These two colours have the maximum distance in FLIP.
inline TestPair greenAndBlue() {
    return {[](int, int, int c) { return c == 1 ? 1.0 : 0.0; },
            [](int x, int, int c) { return c == (x < 60 ? 1 : 2) ? 1.0 : 0.0; }};
}

/// Two puffs of dust over a gradient. In `image` one of them has moved by a pixel and there is a third.
inline TestPair puffs() {
    const auto dust = [](int moved) {
        return [moved](int x, int y, int c) {
            const auto puff = [&](double cx, double cy, double s) {
                return std::exp(-((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (2 * s * s));
            };
            const double tau = 1.2 * puff(50, 40, 12) + 0.8 * puff(75 + moved, 50, 9) + 0.3 * moved * puff(30, 60, 6);
            const double alpha = 1 - std::exp(-tau);
            const double colour = c == 0 ? 0.55 : c == 1 ? 0.45 : 0.35;
            return alpha * colour + (1 - alpha) * (0.1 + 0.3 * y / 90 + 0.02 * c);
        };
    };
    return {dust(0), dust(1)};
}

}  // namespace dustbench::measure
