#include "methods/kit/particles/formulae_experiment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>

#include "methods/kit/findings/findings.h"
#include "methods/kit/findings/timing.h"
#include "methods/kit/maths/bezier.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::particles::formulae {
namespace {

enum Stream : std::uint32_t { controlStream = 1, timeStream, forceStream };

using Controls = std::array<float, 4>;

Controls controlsOf(std::uint64_t seed, std::int64_t draw) {
    const auto u = maths::uniform4(seed, controlStream, static_cast<std::uint64_t>(draw));
    return {u[0], u[1], u[2], u[3]};
}

double uniform(std::uint64_t seed, Stream stream, std::int64_t draw) {
    return static_cast<double>(maths::uniform4(seed, stream, static_cast<std::uint64_t>(draw))[0]);
}

/// Σ C(N, i)·(N − t)^(N−i)·t^i·P_i. Source: Thesis, 4.4.3.
double printedCurve(std::span<const float> controls, double t) {
    const auto degree = static_cast<int>(controls.size()) - 1;
    double sum = 0, binomial = 1;
    for (int i = 0; i <= degree; ++i) {
        sum += binomial * std::pow(degree - t, degree - i) * std::pow(t, i) *
               static_cast<double>(controls[static_cast<std::size_t>(i)]);
        binomial *= static_cast<double>(degree - i) / (i + 1);
    }
    return sum;
}

double correctedCurve(const Controls& p, double t) {
    return static_cast<double>(maths::bezier(p[0], p[1], p[2], p[3], static_cast<float>(t)));
}

/// a = m·ΣF. Source: Thesis, 5.1.
double printedAcceleration(double mass, double force) {
    return mass * force;
}

/// a = ΣF/m.
double correctedAcceleration(double mass, double force) {
    return force / mass;
}

/// m·v over F·t after a second of v ← v + a·Δt from rest.
double momentumOverImpulse(double mass, double force, const std::function<double(double, double)>& acceleration) {
    constexpr int steps = 60;
    constexpr double stepSeconds = 1.0 / steps;
    double velocity = 0;
    for (int step = 0; step < steps; ++step) velocity += acceleration(mass, force) * stepSeconds;
    return mass * velocity / (force * steps * stepSeconds);
}

/// The sum of Bernstein polynomials as written: Σ C(N, i)·(1 − t)^(N−i)·t^i·P_i.
double bernsteinCurve(std::span<const float> controls, double t) {
    const auto degree = static_cast<int>(controls.size()) - 1;
    double sum = 0, binomial = 1;
    for (int i = 0; i <= degree; ++i) {
        sum += binomial * std::pow(1 - t, degree - i) * std::pow(t, i) *
               static_cast<double>(controls[static_cast<std::size_t>(i)]);
        binomial *= static_cast<double>(degree - i) / (i + 1);
    }
    return sum;
}

/// Six control points of one channel, as in the thesis's figure.
std::array<float, 6> sixControlsOf(std::uint64_t seed, std::int64_t draw) {
    const Controls a = controlsOf(seed, 2 * draw), b = controlsOf(seed, 2 * draw + 1);
    return {a[0], a[1], a[2], a[3], b[0], b[1]};
}

/// Each step's points have separate names, so that the compiler keeps them in registers.
template <std::size_t count>
float casteljau(const std::array<float, count>& points, float t) {
    if constexpr (count == 1) {
        return points[0];
    } else {
        std::array<float, count - 1> left;
        for (std::size_t i = 0; i + 1 < count; ++i) left[i] = maths::interpolate(points[i], points[i + 1], t);
        return casteljau(left, t);
    }
}

// One call per particle, as in the thesis's program. Otherwise the compiler evaluates many particles at once with one
// algorithm, but not with the other.
template <std::size_t count>
[[gnu::noinline]] float callCasteljau(const std::array<float, count>& points, float t) {
    return casteljau(points, t);
}
template <std::size_t count>
[[gnu::noinline]] float callSum(const std::array<float, count>& weights, float t) {
    return maths::bernsteinSum(weights, t);
}

/// Time of de Casteljau's algorithm over that of the sum, for curves of `count` points at many moments; `again`: over
/// its own time.
template <std::size_t count>
Finding timeRatio(std::string quantity, std::uint64_t seed, bool again) {
    constexpr std::int64_t moments = 200'000;
    constexpr int repetitions = 15;
    std::array<float, count> points{};
    for (std::size_t i = 0; i < count; ++i)
        points[i] = static_cast<float>(uniform(seed, controlStream, static_cast<std::int64_t>(i)));
    std::array<float, count> weights{};
    std::ranges::copy(maths::bernsteinWeights(points), weights.begin());
    std::vector<float> times;
    for (std::int64_t i = 0; i < moments; ++i) times.push_back(static_cast<float>(uniform(seed, timeStream, i)));
    const auto secondsOfCurve = [&](const auto& curve) {
        return findings::secondsOf([&] {
            float sum = 0;
            for (const float t : times) sum += curve(t);
            volatile float needed = sum;  // otherwise the compiler moves the work out of the timed section
            static_cast<void>(needed);
        });
    };
    const auto steps = [&](float t) { return callCasteljau(points, t); };
    const auto sum = [&](float t) { return callSum(weights, t); };
    std::vector<double> ratios;
    for (int k = 0; k < repetitions; ++k) {
        const double above = secondsOfCurve(steps);
        ratios.push_back(above / (again ? secondsOfCurve(steps) : secondsOfCurve(sum)));
    }
    return findings::medianOf(std::move(quantity), std::move(ratios));
}

Finding meanOf(const char* quantity, std::int64_t draws, const std::function<double(std::int64_t)>& value) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(draws));
    for (std::int64_t i = 0; i < draws; ++i) values.push_back(value(i));
    return findings::meanOf(quantity, values);
}

}  // namespace

std::vector<Finding> measureFormulae(std::uint64_t seed, std::int64_t draws) {
    const auto lastOf = [](const auto& controls) { return static_cast<double>(controls.back()); };
    const auto printedEnd = [&](std::int64_t i) {
        const Controls p = controlsOf(seed, i);
        return std::abs(printedCurve(p, 1) - lastOf(p));
    };
    const auto printedEndOfTwo = [&](std::int64_t i) {
        const Controls p = controlsOf(seed, i);
        const auto two = std::span(p).first(2);
        return std::abs(printedCurve(two, 1) - lastOf(two));
    };
    const auto correctedEnd = [&](std::int64_t i) {
        const Controls p = controlsOf(seed, i);
        return std::abs(correctedCurve(p, 1) - lastOf(p));
    };
    const auto ofSix = [&](const auto& curve) {
        return [&, curve](std::int64_t i) {
            const auto six = sixControlsOf(seed, i);
            const double t = uniform(seed, timeStream, i);
            return std::abs(curve(six, t) -
                            static_cast<double>(maths::bezier(std::span<const float>(six), static_cast<float>(t))));
        };
    };
    constexpr Controls ones{1, 1, 1, 1};
    const auto momentum = [&](double mass, const auto& acceleration) {
        return [=](std::int64_t i) {
            return momentumOverImpulse(mass, 0.1 + uniform(seed, forceStream, i), acceleration);
        };
    };
    return {meanOf("bezier_end_printed", draws, printedEnd),
            meanOf("bezier_end_mended", draws, correctedEnd),
            meanOf("bezier_end_printed_2", draws, printedEndOfTwo),
            meanOf("bezier_six_by_sum", draws, ofSix(bernsteinCurve)),
            meanOf("bezier_six_printed", draws, ofSix(printedCurve)),
            meanOf("bezier_equal_printed", draws,
                   [&](std::int64_t i) { return printedCurve(ones, uniform(seed, timeStream, i)); }),
            meanOf("bezier_equal_mended", draws,
                   [&](std::int64_t i) { return correctedCurve(ones, uniform(seed, timeStream, i)); }),
            meanOf("acceleration_2kg_printed", draws, [](std::int64_t) { return printedAcceleration(2, 1); }),
            meanOf("acceleration_2kg_mended", draws, [](std::int64_t) { return correctedAcceleration(2, 1); }),
            meanOf("momentum_2kg_printed", draws, momentum(2, printedAcceleration)),
            meanOf("momentum_2kg_mended", draws, momentum(2, correctedAcceleration)),
            meanOf("momentum_1kg_printed", draws, momentum(1, printedAcceleration))};
}

std::vector<Finding> measureCurveTimes(std::uint64_t seed) {
    return {timeRatio<6>("casteljau_over_sum_6", seed, false), timeRatio<24>("casteljau_over_sum_24", seed, false),
            timeRatio<6>("casteljau_over_casteljau_6", seed, true)};
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures two formulae that the thesis prints with errors: weights of Bézier curves, a = m·ΣF.";
    info.source = "Thesis";
    info.run = [](ExperimentContext& context) {
        std::vector<Finding> findings = measureFormulae(context.seed(), 10'000);
        for (Finding& finding : measureCurveTimes(context.seed())) findings.push_back(std::move(finding));
        return findings;
    };
    return info;
}

}  // namespace dustbench::particles::formulae
