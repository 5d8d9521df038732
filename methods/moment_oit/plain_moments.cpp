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

namespace {

/// Powers of z of a point.
std::vector<double> powersOf(double total, double z, int count) {
    std::vector<double> b;
    for (int j = 0; j <= count; ++j) b.push_back(total * std::pow(z, j));
    return b;
}

/// E[exp(i·k·φ)] of a normal distribution of φ, k = 1 … count/2; a variance of 0 makes it a point.
std::vector<double> circleMoments(double total, double phase, double variance, int count) {
    std::vector<double> b{total};
    for (int k = 1; k <= count / 2; ++k) {
        const double size = total * std::exp(-0.5 * k * k * variance);
        b.push_back(size * std::cos(k * phase));
        b.push_back(size * std::sin(k * phase));
    }
    return b;
}

}  // namespace

std::vector<double> momentsOf(const RaySurface& surface, const WarpedDepth& depth, const Kind& kind) {
    const double z = depth.at(surface.metres);
    return kind.basis == Basis::power ? powersOf(surface.depth, z, kind.count)
                                      : circleMoments(surface.depth, phaseOf(z), 0, kind.count);
}

std::vector<double> momentsOf(const RayPuff& puff, const WarpedDepth& depth, const Kind& kind) {
    const Profile profile = profileOf(puff);
    const double middle = std::max(profile.meanMetres, leastMetres);
    const double slope = depth.slopeAt(middle);
    if (kind.basis == Basis::trigonometric) {
        const double turn = slope * phaseSlope;
        return circleMoments(profile.depth, phaseOf(depth.at(middle)), turn * turn * profile.varianceSquareMetres,
                             kind.count);
    }
    const Limits limits = limitsOf(puff);
    std::vector<double> m = normalMoments(limits.begin, limits.end, kind.count);
    const double z = depth.at(middle) + slope * (puff.footMetres - middle);
    const double width = slope * std::numbers::sqrt2 * puff.deviationMetres;
    // E[(z + width·x)ʲ] by the binomial theorem.
    std::vector<double> b;
    for (int j = 0; j <= kind.count; ++j) {
        double sum = 0, binomial = 1;
        for (int i = 0; i <= j; ++i) {
            sum += binomial * std::pow(z, j - i) * std::pow(width, i) * m[static_cast<std::size_t>(i)];
            binomial *= static_cast<double>(j - i) / (i + 1);
        }
        b.push_back(puff.whole * sum);
    }
    return b;
}

}  // namespace dustbench::moment_oit
