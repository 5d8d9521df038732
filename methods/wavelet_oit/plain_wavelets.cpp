#include "methods/wavelet_oit/plain_wavelets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dustbench::wavelet_oit {
namespace {

/// ∫ erf
double erfIntegral(double x) {
    return x * std::erf(x) + std::exp(-x * x) * std::numbers::inv_sqrtpi;
}

double ownMeanOver(const Part& part, std::size_t cell, std::size_t count) {
    const auto n = static_cast<double>(count), from = static_cast<double>(cell);
    return n * (integralTo(part, (from + 1) / n) - integralTo(part, from / n));
}

}  // namespace

double MappedDepth::at(double metres) const {
    const double share = warp == Warp::log ? std::log(metres / nearestMetres) / std::log(farthestMetres / nearestMetres)
                                           : (metres - nearestMetres) / (farthestMetres - nearestMetres);
    return last * share;
}

double MappedDepth::slopeAt(double metres) const {
    return last /
           (warp == Warp::log ? metres * std::log(farthestMetres / nearestMetres) : farthestMetres - nearestMetres);
}

double integralTo(const Part& part, double z) {
    if (part.width == 0) return part.depth * std::max(z - part.at, 0.0);
    const double x = (z - part.centre) / part.width, cut = std::clamp(x, part.begin, part.end);
    const double inside = erfIntegral(cut) - erfIntegral(part.begin) - (cut - part.begin) * std::erf(part.begin);
    return part.width * (0.5 * part.whole * inside + part.depth * std::max(x - part.end, 0.0));
}

std::vector<double> coefficientsOf(const Part& part, int rank) {
    const std::size_t count = std::size_t{2} << rank;
    std::vector<double> integral(count + 1), coefficients(count);
    for (std::size_t i = 0; i <= count; ++i)
        integral[i] = integralTo(part, static_cast<double>(i) / static_cast<double>(count));
    coefficients[0] = integral[count] - integral[0];
    for (std::size_t wavelets = 1; wavelets < count; wavelets *= 2)  // of a level: 2^j
        for (std::size_t k = 0; k < wavelets; ++k) {
            const std::size_t cells = count / wavelets, from = k * cells;
            coefficients[wavelets + k] = std::sqrt(static_cast<double>(wavelets)) *
                                         (integral[from] - 2 * integral[from + cells / 2] + integral[from + cells]);
        }
    return coefficients;
}

double meanOver(std::span<const double> coefficients, std::size_t cell) {
    double mean = coefficients[0];
    for (std::size_t wavelets = 1; wavelets < coefficients.size(); wavelets *= 2) {
        const std::size_t cells = coefficients.size() / wavelets;
        const double side = cell % cells < cells / 2 ? -1 : 1;
        mean += side * std::sqrt(static_cast<double>(wavelets)) * coefficients[wavelets + cell / cells];
    }
    return mean;
}

double depthBefore(std::span<const double> coefficients, const Part& own) {
    const std::size_t count = coefficients.size();
    const double n = static_cast<double>(count), place = std::min(own.at * n + (own.width > 0 ? 0.5 : 0), n);
    const std::size_t cell = std::min(static_cast<std::size_t>(place), count - 1);
    const double near = cell == 0 ? 0 : meanOver(coefficients, cell - 1) - ownMeanOver(own, cell - 1, count);
    const double far = meanOver(coefficients, cell) - ownMeanOver(own, cell, count);
    return std::max(std::lerp(near, far, place - static_cast<double>(cell)), 0.0);
}

}  // namespace dustbench::wavelet_oit
