// The published variants of the method: power or trigonometric moments, 4, 6 or 8 of them, in floats or 16 bits; their
// biases and quantisation transforms.
//
// A pixel stores its depth b₀ and `count` numbers: bⱼ = Σ aᵢ·zᵢʲ, or the real and imaginary parts of Σ aᵢ·exp(i·k·φᵢ),
// k = 1 … count/2. φ grows with z from 0 to 2π − `wrappingZone`; the zone keeps the far end apart from the near end.
//
// In 16 bits, moments are stored divided by b₀. Power moments would use a small part of [0, 1]ⁿ; a linear transform of
// the even and one of the odd moments spreads them. Trigonometric ones only need to be moved to [0, 1].
//
// Source: Munstermann2018 and its supplement; PetersKlein2015. Threads: pure.
#pragma once

#include <numbers>
#include <span>
#include <vector>

namespace dustbench::moment_oit {

enum class Basis { power, trigonometric };
enum class Precision { single, quantised };

struct Kind {
    Basis basis = Basis::power;
    Precision precision = Precision::single;
    int count = 6;  ///< 4, 6 or 8 numbers, in addition to b₀

    bool operator==(const Kind&) const = default;
};

inline constexpr double wrappingZone = 0.1 * std::numbers::pi;  ///< radians

/// Share β of `towards` in the moments, large enough to hide their rounding.
[[nodiscard]] double biasOf(const Kind& kind);

/// The moments b₁ … that biased moments move to: of a measure whose Hankel or Toeplitz matrix is far from singular.
[[nodiscard]] std::span<const double> towards(const Kind& kind);

/// A square matrix, by rows, that maps the even or the odd power moments, and the numbers then added.
struct Transform {
    std::span<const double> matrix, offset;
};
[[nodiscard]] Transform oddTransform(int count);
[[nodiscard]] Transform evenTransform(int count);
[[nodiscard]] std::vector<double> inverseOf(std::span<const double> matrix);

/// Maps moments b₁ … of a measure of total 1 to [0, 1]ⁿ, and back.
[[nodiscard]] std::vector<double> quantised(const Kind& kind, std::span<const double> moments);
[[nodiscard]] std::vector<double> dequantised(const Kind& kind, std::span<const double> stored);

}  // namespace dustbench::moment_oit
