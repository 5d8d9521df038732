#include <algorithm>
#include <cmath>
#include <limits>

#include "methods/weighted_oit/weighted_oit.h"

namespace dustbench::weighted_oit {
namespace {

/// The nearest number of half precision, ties to even: 11 significant bits, steps of at least 2⁻²⁴.
double toHalf(double value) {
    int exponent = 0;
    (void)std::frexp(value, &exponent);
    const int last = std::max(exponent - 11, -24);
    const double rounded = std::ldexp(std::nearbyint(std::ldexp(value, -last)), last);
    return std::abs(rounded) > largestHalf ? std::copysign(std::numeric_limits<double>::infinity(), value) : rounded;
}

double toByte(double value) {
    return std::nearbyint(255 * value) / 255;
}

double rounded(Accumulation format, double value) {
    return format == Accumulation::rgba16f ? toHalf(value) : value;
}

double rounded(Revealage format, double value) {
    switch (format) {
        case Revealage::r32f:
            return value;
        case Revealage::r16f:
            return toHalf(value);
        case Revealage::r8:
            return toByte(value);
    }
    return value;
}

}  // namespace

glm::dvec4 plainPixel(const Settings& settings, std::span<const Fragment> fragments, double nearMetres) {
    glm::dvec4 sum(0);
    double revealage = 1;
    for (const Fragment& fragment : fragments) {
        const double alpha = -std::expm1(-fragment.opticalDepth);
        const double share = alpha * plainWeight(settings.weight, fragment.axisMetres, alpha, nearMetres);
        const glm::dvec4 weighted(share * fragment.colour, share);
        for (int c = 0; c < 4; ++c) sum[c] = rounded(settings.accumulation, sum[c] + weighted[c]);
        revealage = rounded(settings.revealage, (1 - alpha) * revealage);
    }
    if (sum.a == 0) return glm::dvec4(0, 0, 0, 1 - revealage);
    if (settings.accumulation == Accumulation::rgba16f) {
        sum = glm::min(sum, glm::dvec4(largestHalf));
        sum.a = std::max(sum.a, leastDivisor);
    }
    return {glm::dvec3(sum) / sum.a * (1 - revealage), 1 - revealage};
}

}  // namespace dustbench::weighted_oit
