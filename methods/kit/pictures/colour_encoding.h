// How an image file encodes its colours, and the conversion to linear light.
//
// Threads: pure.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "methods/kit/maths/srgb.h"

namespace dustbench::pictures {

struct ColourEncoding {
    enum class Kind { linear, srgb, power, unknown } kind = Kind::srgb;
    float exponent = 1;  ///< of `power`: linear = encoded^exponent
    std::string name{};  ///< of `unknown`: its name in the file

    /// For an exponent from a file: linear = encoded^exponent. Within 5 % of 2.2 it counts as sRGB, which writers of
    /// PNG approximate by this power; libpng does the same.
    [[nodiscard]] static ColourEncoding ofPower(float exponent) {
        if (std::abs(exponent / 2.2f - 1) < 0.05f) return {Kind::srgb};
        return {Kind::power, exponent};
    }

    /// Decodes one channel; returns values of an unknown encoding unchanged.
    [[nodiscard]] float decoded(float value) const {
        if (kind == Kind::srgb) return maths::decodeSrgb(value);
        return kind == Kind::power ? std::pow(std::max(value, 0.0f), exponent) : value;
    }
    /// Empty if the colours can be decoded; otherwise the reason.
    [[nodiscard]] std::string refusal() const {
        if (kind != Kind::unknown) return "";
        return "its colours are encoded as '" + name + "', expected sRGB, Rec709, linear or a gamma";
    }
};

}  // namespace dustbench::pictures
