#include "methods/moment_oit/plain_moments.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dustbench::moment_oit {
namespace {

constexpr double leastMetres = 0.001;

/// ∫ xᵏ·exp(−x²)/√π dx from begin to end, x = (t − tc)/(√2·s).
std::vector<double> normalMoments(double begin, double end, int count) {
    begin = std::clamp(begin, -6.0, 6.0);
    end = std::clamp(end, -6.0, 6.0);
    std::vector<double> m{0.5 * (std::erf(end) - std::erf(begin))};
    const auto edge = [](double x, int power) {
        return std::pow(x, power) * std::exp(-x * x) / (2 * std::sqrt(std::numbers::pi));
    };
    for (int k = 1; k <= count; ++k)
        m.push_back(edge(begin, k - 1) - edge(end, k - 1) +
                    (k > 1 ? 0.5 * (k - 1) * m[static_cast<std::size_t>(k) - 2] : 0));
    return m;
}

struct Limits {
    double begin, end;
};
Limits limitsOf(const RayPuff& puff) {
    const double width = std::numbers::sqrt2 * puff.deviationMetres;
    return {(puff.beginMetres - puff.footMetres) / width, (puff.endMetres - puff.footMetres) / width};
}

/// Roots of Σ cᵢ·xⁱ, all of them real: a quadratic or a cubic.
std::vector<double> rootsOf(const std::vector<double>& c) {
    if (c.size() == 3) {
        const double p = c[1] / (2 * c[2]), q = c[0] / c[2];
        const double r = std::sqrt(std::max(p * p - q, 0.0));
        return {-p - r, -p + r};
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

}  // namespace

double WarpedDepth::at(double metres) const {
    if (warp == Warp::linear) return 2 * (metres - nearestMetres) / (farthestMetres - nearestMetres) - 1;
    return 2 * std::log(metres / nearestMetres) / std::log(farthestMetres / nearestMetres) - 1;
}

double WarpedDepth::slopeAt(double metres) const {
    if (warp == Warp::linear) return 2 / (farthestMetres - nearestMetres);
    return 2 / (metres * std::log(farthestMetres / nearestMetres));
}

Profile profileOf(const RayPuff& puff) {
    const Limits limits = limitsOf(puff);
    const std::vector<double> m = normalMoments(limits.begin, limits.end, 2);
    const double width = std::numbers::sqrt2 * puff.deviationMetres;
    if (m[0] < 1e-5) return {puff.whole * m[0], puff.footMetres + width * std::clamp(0.0, limits.begin, limits.end), 0};
    const double mean = std::clamp(m[1] / m[0], limits.begin, limits.end);
    return {puff.whole * m[0], puff.footMetres + width * mean,
            width * width * std::max(m[2] / m[0] - mean * mean, 0.0)};
}

std::vector<double> momentsOf(const RayPuff& puff, const WarpedDepth& depth, int count, bool asPoint) {
    const Profile profile = profileOf(puff);
    const double middle = std::max(profile.meanMetres, leastMetres);
    std::vector<double> b;
    if (asPoint) {
        for (int j = 0; j <= count; ++j) b.push_back(profile.depth * std::pow(depth.at(middle), j));
        return b;
    }
    const Limits limits = limitsOf(puff);
    std::vector<double> m = normalMoments(limits.begin, limits.end, count);
    const double slope = depth.slopeAt(middle);
    const double z = depth.at(middle) + slope * (puff.footMetres - middle);
    const double width = slope * std::numbers::sqrt2 * puff.deviationMetres;
    // E[(z + width·x)ʲ] by the binomial theorem.
    for (int j = 0; j <= count; ++j) {
        double sum = 0, binomial = 1;
        for (int i = 0; i <= j; ++i) {
            sum += binomial * std::pow(z, j - i) * std::pow(width, i) * m[static_cast<std::size_t>(i)];
            binomial *= static_cast<double>(j - i) / (i + 1);
        }
        b.push_back(puff.whole * sum);
    }
    return b;
}

double biasOf(int count) {
    return count == 4 ? 5e-7 : 5e-6;
}

double transmittance(std::span<const double> moments, double z, double bias, double overestimation) {
    const std::array<double, 5> towardsFour{1, 0, 0.375, 0, 0.375};
    const std::array<double, 7> towardsSix{1, 0, 0.48, 0, 0.451, 0, 0.45};
    const std::size_t points = moments.size() / 2 + 1;
    std::vector<double> b;
    for (std::size_t j = 0; j < moments.size(); ++j)
        b.push_back((1 - bias) * moments[j] / moments[0] +
                    bias * (moments.size() == 5 ? towardsFour.at(j) : towardsSix.at(j)));
    // H·c = (1, z, z² …) by Gaussian elimination.
    std::vector<std::vector<double>> rows(points, std::vector<double>(points + 1));
    for (std::size_t i = 0; i < points; ++i) {
        for (std::size_t j = 0; j < points; ++j) rows[i][j] = b[i + j];
        rows[i][points] = std::pow(z, static_cast<double>(i));
    }
    for (std::size_t i = 0; i < points; ++i)
        for (std::size_t k = i + 1; k < points; ++k) {
            const double factor = rows[k][i] / rows[i][i];
            for (std::size_t j = i; j <= points; ++j) rows[k][j] -= factor * rows[i][j];
        }
    std::vector<double> c(points);
    for (std::size_t i = points; i-- > 0;) {
        c[i] = rows[i][points];
        for (std::size_t j = i + 1; j < points; ++j) c[i] -= rows[i][j] * c[j];
        c[i] /= rows[i][i];
    }
    std::vector<double> x{z};
    for (const double root : rootsOf(c)) x.push_back(root);
    // Lagrange: the mean of the polynomial with the values 1, 0 or `overestimation` at the points.
    double share = 0;
    for (std::size_t i = 0; i < points; ++i) {
        const double value = i == 0 ? overestimation : x[i] < z ? 1 : 0;
        std::vector<double> basis{1};  // Π (x − x_k)/(x_i − x_k), coefficients from the constant on
        for (std::size_t k = 0; k < points; ++k) {
            if (k == i) continue;
            std::vector<double> product(basis.size() + 1);
            for (std::size_t n = 0; n < basis.size(); ++n) {
                product[n + 1] += basis[n] / (x[i] - x[k]);
                product[n] -= basis[n] * x[k] / (x[i] - x[k]);
            }
            basis = std::move(product);
        }
        double weight = 0;
        for (std::size_t n = 0; n < basis.size(); ++n) weight += basis[n] * b[n];
        share += value * weight;
    }
    return std::exp(-moments[0] * std::clamp(share, 0.0, 1.0));
}

}  // namespace dustbench::moment_oit
