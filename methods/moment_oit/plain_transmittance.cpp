#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <utility>

#include "methods/moment_oit/plain_moments.h"

namespace dustbench::moment_oit {
namespace {

using Complex = std::complex<double>;

/// Roots of Σ cᵢ·xⁱ, all of them real: of degree two, three or four.
std::vector<double> realRootsOf(const std::vector<double>& c) {
    if (c.size() == 3) {
        const double p = c[1] / (2 * c[2]), q = c[0] / c[2];
        const double r = std::sqrt(std::max(p * p - q, 0.0));
        return {-p - r, -p + r};
    }
    if (c.size() == 5) {  // those of the derivative separate them: bisection
        const auto value = [&](double x) { return (((c[4] * x + c[3]) * x + c[2]) * x + c[1]) * x + c[0]; };
        std::vector<double> ends = realRootsOf({c[1], 2 * c[2], 3 * c[3], 4 * c[4]});
        const double reach =
            1 + std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2]), std::abs(c[3])}) / std::abs(c[4]);
        ends.insert(ends.end(), {-reach, reach});
        std::ranges::sort(ends);
        std::vector<double> roots;
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            double low = ends[i], high = ends[i + 1];
            const bool falls = value(low) > 0;
            for (int step = 0; step < 200; ++step) {
                const double middle = 0.5 * (low + high);
                ((value(middle) > 0) == falls ? low : high) = middle;
            }
            roots.push_back(0.5 * (low + high));
        }
        return roots;
    }
    const double a = c[2] / (3 * c[3]), p = c[1] / c[3], q = c[0] / c[3];
    const double third = std::max(a * a - p / 3, 1e-300);
    const double around = a * a * a - 0.5 * a * p + 0.5 * q;
    const double angle = std::acos(std::clamp(-around / std::pow(third, 1.5), -1.0, 1.0)) / 3;
    std::vector<double> roots;
    roots.reserve(3);
    for (int i = 0; i < 3; ++i)
        roots.push_back(2 * std::sqrt(third) * std::cos(angle - 2 * std::numbers::pi / 3 * i) - a);
    return roots;
}

/// Roots of Σ cᵢ·xⁱ, all of them on the unit circle, by the iteration of Weierstrass.
std::vector<Complex> circleRootsOf(const std::vector<Complex>& c) {
    const std::size_t degree = c.size() - 1;
    std::vector<Complex> roots;
    for (std::size_t i = 0; i < degree; ++i)
        roots.push_back(
            std::polar(1.1, 0.4 + 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(degree)));
    double change = 1;
    for (int step = 0; step < 300 && change > 1e-14; ++step) {
        change = 0;
        for (std::size_t i = 0; i < degree; ++i) {
            Complex value = 0, others = c[degree];
            for (std::size_t k = degree + 1; k-- > 0;) value = value * roots[i] + c[k];
            for (std::size_t k = 0; k < degree; ++k)
                if (k != i) others *= roots[i] - roots[k];
            if (others == Complex(0)) continue;
            roots[i] -= value / others;
            change = std::max(change, std::abs(value / others));
        }
    }
    for (Complex& root : roots) root /= std::abs(root);
    return roots;
}

/// Solves a linear system by Gaussian elimination with pivots; the right-hand side is each row's last number.
template <typename Number>
std::vector<Number> solved(std::vector<std::vector<Number>> rows) {
    const std::size_t size = rows.size();
    for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t k = i + 1; k < size; ++k)
            if (std::abs(rows[k][i]) > std::abs(rows[i][i])) std::swap(rows[k], rows[i]);
        for (std::size_t k = i + 1; k < size; ++k) {
            const Number factor = rows[k][i] / rows[i][i];
            for (std::size_t j = i; j <= size; ++j) rows[k][j] -= factor * rows[i][j];
        }
    }
    std::vector<Number> x(size);
    for (std::size_t i = size; i-- > 0;) {
        x[i] = rows[i][size];
        for (std::size_t j = i + 1; j < size; ++j) x[i] -= rows[i][j] * x[j];
        x[i] /= rows[i][i];
    }
    return x;
}

/// Coefficients of the polynomial whose roots and z are the points of the measure: M·c = (1, z, z² …).
template <typename Number>
std::vector<Number> polynomialOf(std::size_t points, Number z,
                                 const std::function<Number(std::size_t, std::size_t)>& matrix) {
    std::vector<std::vector<Number>> rows(points, std::vector<Number>(points + 1));
    for (std::size_t i = 0; i < points; ++i) {
        for (std::size_t j = 0; j < points; ++j) rows[i][j] = matrix(i, j);
        rows[i][points] = i == 0 ? Number(1) : rows[i - 1][points] * z;
    }
    return solved(std::move(rows));
}

/// Weights of the points with the moments 1, b₁ … : Σ wₖ·xₖʲ = bⱼ.
template <typename Number>
std::vector<double> weightsOf(const std::vector<Number>& x, const std::vector<Number>& b) {
    std::vector<std::vector<Number>> rows(x.size(), std::vector<Number>(x.size() + 1));
    for (std::size_t k = 0; k < x.size(); ++k) {
        rows[0][k] = 1;
        for (std::size_t j = 1; j < x.size(); ++j) rows[j][k] = rows[j - 1][k] * x[k];
    }
    for (std::size_t j = 0; j < x.size(); ++j) rows[j][x.size()] = b[j];
    std::vector<double> weights;
    for (const Number& weight : solved(std::move(rows))) weights.push_back(std::real(weight));
    return weights;
}

double shareOfPower(const std::vector<double>& b, double z, double overestimation) {
    const std::size_t points = b.size() / 2 + 1;
    std::vector<double> x{z};
    for (const double root : realRootsOf(polynomialOf<double>(points, z, [&](auto i, auto j) { return b[i + j]; })))
        x.push_back(root);
    const std::vector<double> weights = weightsOf(x, b);
    double share = overestimation * weights[0];
    for (std::size_t k = 1; k < points; ++k) share += x[k] < z ? weights[k] : 0;
    return share;
}

double shareOnCircle(const std::vector<double>& numbers, double z, double overestimation) {
    std::vector<Complex> b{1};
    for (std::size_t j = 1; j < numbers.size(); j += 2) b.emplace_back(numbers[j], numbers[j + 1]);
    const std::size_t points = b.size();
    const Complex place = std::polar(1.0, phaseOf(z));
    std::vector<Complex> c =
        polynomialOf<Complex>(points, place, [&](auto i, auto j) { return i >= j ? b[i - j] : std::conj(b[j - i]); });
    for (Complex& one : c) one = std::conj(one);
    std::vector<Complex> x{place};
    for (const Complex& root : circleRootsOf(c)) x.push_back(root);
    const std::vector<double> weights = weightsOf(x, b);
    double share = overestimation * weights[0];
    for (std::size_t k = 1; k < points; ++k) {
        const double angle = std::arg(x[k]) < 0 ? std::arg(x[k]) + 2 * std::numbers::pi : std::arg(x[k]);
        const double inZone = std::clamp((angle - 2 * std::numbers::pi) / wrappingZone + 1, 0.0, 1.0);
        share += weights[k] * (angle < phaseOf(z) ? 1 : inZone);
    }
    return share;
}

}  // namespace

double transmittance(std::span<const double> moments, double z, const Kind& kind, double bias, double overestimation) {
    std::vector<double> b{1};
    for (std::size_t j = 1; j < moments.size(); ++j)
        b.push_back((1 - bias) * moments[j] / moments[0] + bias * towards(kind)[j - 1]);
    const double share =
        kind.basis == Basis::power ? shareOfPower(b, z, overestimation) : shareOnCircle(b, z, overestimation);
    return std::exp(-moments[0] * std::clamp(share, 0.0, 1.0));
}

}  // namespace dustbench::moment_oit
