#include "bench/measure/steadiness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>

#include "bench/measure/statistics.h"

namespace dustbench::measure {
namespace {

constexpr std::size_t minimumFrames = 30;
constexpr double enoughChange = 0.05;        // of the median, for warm-up and drift
constexpr double enoughErrors = 4;           // standard errors
constexpr double enoughDistance = 0.10;      // between two speeds
constexpr double enoughSeparation = 4.5;     // D
constexpr double minimumShare = 0.1;         // of the frames at the less frequent speed
constexpr std::size_t maximumRanked = 1000;  // the number of pairs grows with the square

double standardDeviation(std::span<const double> values, double middle) {
    std::vector<double> distances;
    for (const double value : values) distances.push_back(std::abs(value - middle));
    return 1.4826 * median(distances);
}

/// Removes stalled frames from `frames`.
std::optional<std::string> takeStalls(std::vector<double>& frames) {
    const double middle = median(frames);
    const double limit = std::max(1.5 * middle, middle + 8 * standardDeviation(frames, middle));
    const auto stalls = std::ranges::count_if(frames, [limit](double ms) { return ms > limit; });
    if (stalls == 0) return std::nullopt;
    const auto longest = std::ranges::max_element(frames);
    std::string text =
        fmt::format("{} of {} frames stalled: over {:.3g} ms, frame {} took {:.3g} ms; the median is {:.3g} ms", stalls,
                    frames.size(), limit, longest - frames.begin(), *longest, middle);
    std::erase_if(frames, [limit](double ms) { return ms > limit; });
    return text;
}

std::optional<std::string> warmUp(std::span<const double> first, std::span<const double> rest) {
    const double early = median(first), late = median(rest);
    const double deviation = standardDeviation(rest, late);
    const double error = 1.2533 * deviation *
                         std::sqrt(1.0 / static_cast<double>(first.size()) + 1.0 / static_cast<double>(rest.size()));
    if (early - late <= enoughChange * late || early - late <= enoughErrors * error) return std::nullopt;
    return fmt::format("the warm-up had not ended: the first {} frames took {:.3g} ms (median), the others {:.3g} ms",
                       first.size(), early, late);
}

std::optional<std::string> drift(std::span<const double> frames) {
    // At most `maximumRanked` frames, evenly spaced.
    std::vector<double> y;
    const std::size_t step = (frames.size() + maximumRanked - 1) / maximumRanked;
    for (std::size_t i = 0; i < frames.size(); i += step) y.push_back(frames[i]);
    const auto n = static_cast<double>(y.size());
    std::vector<double> slopes;
    std::int64_t rising = 0;  // Kendall's S
    for (std::size_t i = 0; i < y.size(); ++i)
        for (std::size_t j = i + 1; j < y.size(); ++j) {
            slopes.push_back((y[j] - y[i]) / static_cast<double>(j - i));
            rising += y[j] > y[i] ? 1 : y[j] < y[i] ? -1 : 0;
        }
    const double z = static_cast<double>(rising) / std::sqrt(n * (n - 1) * (2 * n + 5) / 18);
    const double change = median(slopes) * (n - 1), middle = median(y);
    if (std::abs(z) <= enoughErrors || std::abs(change) <= enoughChange * middle) return std::nullopt;
    return fmt::format("frame times drift: {:+.1f} % from the beginning of the run to its end", 100 * change / middle);
}

std::optional<std::string> twoSpeeds(std::span<const double> frames) {
    std::vector<double> sorted(frames.begin(), frames.end());
    std::ranges::sort(sorted);
    const double total = std::accumulate(sorted.begin(), sorted.end(), 0.0);
    const auto n = static_cast<double>(sorted.size());
    // Minimising the sum of squares within groups maximises that between them: n₁·n₂·(μ₁ − μ₂)².
    std::size_t split = 1;
    double best = -1, below = 0;
    for (std::size_t k = 1; k < sorted.size(); ++k) {
        below += sorted[k - 1];
        const auto n1 = static_cast<double>(k);
        const double distance = below / n1 - (total - below) / (n - n1);
        const double between = n1 * (n - n1) * distance * distance;
        if (between > best) {
            best = between;
            split = k;
        }
    }
    const auto moments = [](std::span<const double> group) {
        double mean = 0, squares = 0;
        for (const double value : group) mean += value / static_cast<double>(group.size());
        for (const double value : group) squares += (value - mean) * (value - mean);
        return std::pair{mean, squares / static_cast<double>(group.size())};
    };
    const std::span<const double> all(sorted);
    const auto [fast, fastVariance] = moments(all.first(split));
    const auto [slow, slowVariance] = moments(all.subspan(split));
    const double share = std::min(static_cast<double>(split), n - static_cast<double>(split)) / n;
    const double separation = std::numbers::sqrt2 * (slow - fast) / std::sqrt(fastVariance + slowVariance);
    if (slow - fast <= enoughDistance * fast || share < minimumShare || !(separation > enoughSeparation))
        return std::nullopt;
    return fmt::format("frames have two speeds: {:.0f} % of them take about {:.3g} ms, the others {:.3g} ms",
                       100 * static_cast<double>(split) / n, fast, slow);
}

}  // namespace

std::vector<std::string> steadinessWarnings(std::span<const double> frameMs) {
    std::vector<std::string> warnings;
    const auto note = [&warnings](std::optional<std::string> text) {
        if (text) warnings.push_back(std::move(*text));
    };
    std::vector<double> frames(frameMs.begin(), frameMs.end());
    if (frames.size() < 2) return warnings;
    note(takeStalls(frames));
    if (frames.size() < minimumFrames) return warnings;
    const std::span<const double> all(frames);
    const std::size_t tenth = frames.size() / 10;
    note(warmUp(all.first(tenth), all.subspan(tenth)));
    note(drift(all.subspan(tenth)));
    note(twoSpeeds(all));
    return warnings;
}

}  // namespace dustbench::measure
