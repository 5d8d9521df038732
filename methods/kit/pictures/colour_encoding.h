// How a picture's file encodes its colours, and the linear light that they mean.
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
    std::string name{};  ///< of `unknown`: what the file calls it

    /// As the file says it: linear = encoded^exponent. Within 5 % of 2.2 this is the power by which writers of PNG
    /// approximate sRGB, which libpng takes for sRGB as well.
    [[nodiscard]] static ColourEncoding ofPower(float exponent) {
        if (std::abs(exponent / 2.2f - 1) < 0.05f) return {Kind::srgb};
        return {Kind::power, exponent};
    }

    /// Of one channel; an unknown one is as it is.
    [[nodiscard]] float decoded(float value) const {
        if (kind == Kind::srgb) return maths::decodeSrgb(value);
        return kind == Kind::power ? std::pow(std::max(value, 0.0f), exponent) : value;
    }
    /// Empty if the colours can be decoded, else the reason why not.
    [[nodiscard]] std::string refusal() const {
        if (kind != Kind::unknown) return "";
        return "its colours are encoded as '" + name + "', expected sRGB, Rec709, linear or a gamma";
    }
};

}  // namespace dustbench::pictures
