// 2^x and the error function in double precision, without branches, so that loops over them vectorise.
//
// Both are made of IEEE operations and values of a table alone: the same bits on every machine and at any vector width.
// Threads: pure.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace dustbench::bench {

/// Added to a small number, it leaves the nearest whole number in the lowest bits of the sum.
inline constexpr double roundingMagic = 0x1.8p52;

/// ln2^k / k!, k = 0..11: Taylor's series of 2^x.
inline constexpr std::array<double, 12> powerSeries = [] {
    std::array<double, 12> series{};
    double term = 1;
    for (int k = 0; k < 12; ++k) {
        series[static_cast<std::size_t>(k)] = term;
        term *= std::numbers::ln2 / (k + 1);
    }
    return series;
}();

/// 2^x, relative error below 2e-15, for |x| ≤ 1000. 2^x = 2^n·2^f with whole n and |f| ≤ ½, where the first term that
/// is left out is (ln2/2)^12/12! = 6e-15.
[[nodiscard]] inline double powerOfTwo(double x) {
    const double shifted = x + roundingMagic;
    const double f = x - (shifted - roundingMagic);
    double power = powerSeries[11];
#pragma GCC unroll 16
    for (std::size_t k = 11; k-- > 0;) power = power * f + powerSeries[k];
    // n goes from the sum's lowest bits into the exponent's place; unsigned, so that a negative n wraps as it should.
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(power) + (std::bit_cast<std::uint64_t>(shifted) << 52));
}

/// ½·erf(z), absolute error below 2e-12: Taylor's series about the nearest of the nodes n/64, |n| ≤ 384.
///
///     erf(x + d) ≈ erf(x) + erf'(x)·d·[1 − x·d + (4x² − 2)/6·d² − (2x³ − 3x)/6·d³],   erf'(x) = 2/√π·exp(−x²)
///
/// Beyond |z| = 6 it is ±½, where erf itself differs from ±1 by 2e-17.
class HalfErrorFunction {
 public:
    [[nodiscard]] static const HalfErrorFunction& instance() {
        static const HalfErrorFunction table;
        return table;
    }

    [[nodiscard]] double operator()(double z) const { return evaluate(nodes_.data() + limit * 64, z); }

    /// The node of 0, for loops: what `evaluate` wants.
    struct Node {
        double half, slope;  ///< ½·erf and its derivative
    };
    [[nodiscard]] const Node* middle() const { return nodes_.data() + limit * 64; }

    [[nodiscard]] static double evaluate(const Node* middle, double z) {
        const double above = z < -limit ? -limit : z;
        const double x = above > limit ? limit : above;
        const double shifted = x * 64 + roundingMagic;
        const double node = (shifted - roundingMagic) * (1.0 / 64);
        const auto index = std::bit_cast<std::int64_t>(shifted) - std::bit_cast<std::int64_t>(roundingMagic);
        const double d = x - node;
        const double square = node * node;
        const double third = (2 * square - 1) * (1.0 / 3);
        const double fourth = node * (0.5 - square * (1.0 / 3));
        return middle[index].half + middle[index].slope * (d * (1 + d * (d * (third + d * fourth) - node)));
    }

 private:
    static constexpr int limit = 6;

    HalfErrorFunction() {
        for (int n = -limit * 64; n <= limit * 64; ++n) {
            const double x = n / 64.0;
            nodes_[static_cast<std::size_t>(n + limit * 64)] = {std::erf(x) / 2,
                                                                std::numbers::inv_sqrtpi * std::exp(-x * x)};
        }
    }

    std::array<Node, 2 * limit * 64 + 1> nodes_{};
};

}  // namespace dustbench::bench
