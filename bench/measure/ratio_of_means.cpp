#include "bench/measure/ratio_of_means.h"

#include <algorithm>
#include <cmath>

#include "bench/measure/paired_ratio.h"

namespace dustbench::bench {

RatioOfMeans ratioOfMeans(std::span<const std::pair<double, double>> pairs, double level) {
    RatioOfMeans result;
    const auto n = static_cast<double>(pairs.size());
    double meanX = 0, meanY = 0;
    for (const auto& [x, y] : pairs) {
        meanX += x / n;
        meanY += y / n;
    }
    if (pairs.empty() || meanY == 0) return result;
    const double ratio = result.ratio = meanX / meanY;
    if (pairs.size() < 2) return result;
    double xx = 0, yy = 0, xy = 0;
    for (const auto& [x, y] : pairs) {
        xx += (x - meanX) * (x - meanX) / (n - 1) / n;
        yy += (y - meanY) * (y - meanY) / (n - 1) / n;
        xy += (x - meanX) * (y - meanY) / (n - 1) / n;
    }
    const double t = studentQuantile((1 + level) / 2, n - 1);
    const double g = t * t * yy / (meanY * meanY);
    if (g >= 1) return result;
    const double shift = t * t * xy / (meanY * meanY);  // g v_xy/v_yy
    const double apart = yy > 0 ? xx - xy * xy / yy : xx;
    const double variance = xx - 2 * ratio * xy + ratio * ratio * yy - g * apart;
    const double half = t / std::abs(meanY) * std::sqrt(std::max(variance, 0.0));
    result.low = (ratio - shift - half) / (1 - g);
    result.high = (ratio - shift + half) / (1 - g);
    return result;
}

}  // namespace dustbench::bench
