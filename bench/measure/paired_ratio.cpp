#include "bench/measure/paired_ratio.h"

#include <fmt/format.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

constexpr Choices<Verdict> verdicts{{"FASTER", Verdict::faster},
                                    {"SLOWER", Verdict::slower},
                                    {"SAME", Verdict::same},
                                    {"UNRESOLVED", Verdict::unresolved}};

}  // namespace

std::string_view verdictName(Verdict verdict) {
    return verdicts.wordOf(verdict);
}

Verdict evaluateInterval(double lowLog, double highLog) {
    const double margin = std::log1p(sameMargin);
    if (highLog < -margin) return Verdict::faster;
    if (lowLog > margin) return Verdict::slower;
    return lowLog >= -margin && highLog <= margin ? Verdict::same : Verdict::unresolved;
}

double studentQuantile(double p, double degreesOfFreedom) {
    return boost::math::quantile(boost::math::students_t(degreesOfFreedom), p);
}

PairedRatio evaluateLogRatios(std::span<const double> logRatios) {
    PairedRatio result;
    result.pairs = logRatios.size();
    if (logRatios.empty()) return result;
    const auto n = static_cast<double>(logRatios.size());
    const double mean = std::accumulate(logRatios.begin(), logRatios.end(), 0.0) / n;
    result.ratio = std::exp(mean);
    if (logRatios.size() < 2) return result;

    double squares = 0;
    for (const double x : logRatios) squares += (x - mean) * (x - mean);
    const double standardError = std::sqrt(squares / (n - 1) / n);
    const double half = studentQuantile((1 + intervalConfidence) / 2, n - 1) * standardError;
    result.low = std::exp(mean - half);
    result.high = std::exp(mean + half);
    if (result.pairs >= minimumPairs) result.verdict = evaluateInterval(mean - half, mean + half);
    return result;
}

PairedRatio comparePaired(std::span<const double> of, std::span<const double> with) {
    if (of.size() != with.size())
        throw InputError(fmt::format("paired times: got {} and {}, expected equally many", of.size(), with.size()));
    std::vector<double> logRatios;
    logRatios.reserve(of.size());
    for (std::size_t i = 0; i < of.size(); ++i) {
        for (const double time : {of[i], with[i]})
            if (!(time > 0) || !std::isfinite(time))
                throw InputError(fmt::format("paired times: got {} in pair {}, expected a number above 0", time, i));
        // Not the logarithm of the quotient, which can overflow.
        logRatios.push_back(std::log(of[i]) - std::log(with[i]));
    }
    return evaluateLogRatios(logRatios);
}

}  // namespace dustbench::bench
