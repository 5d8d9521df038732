#include "methods/kit/particles/formulae_experiment.h"

#include <array>
#include <cmath>
#include <functional>
#include <span>

#include "methods/kit/findings/findings.h"
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

double mendedCurve(const Controls& p, double t) {
    return static_cast<double>(maths::bezier(p[0], p[1], p[2], p[3], static_cast<float>(t)));
}

/// a = m·ΣF. Source: Thesis, 5.1.
double printedAcceleration(double mass, double force) {
    return mass * force;
}

/// a = ΣF/m.
double mendedAcceleration(double mass, double force) {
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
    const auto mendedEnd = [&](std::int64_t i) {
        const Controls p = controlsOf(seed, i);
        return std::abs(mendedCurve(p, 1) - lastOf(p));
    };
    constexpr Controls ones{1, 1, 1, 1};
    const auto momentum = [&](double mass, const auto& acceleration) {
        return [=](std::int64_t i) {
            return momentumOverImpulse(mass, 0.1 + uniform(seed, forceStream, i), acceleration);
        };
    };
    return {meanOf("bezier_end_printed", draws, printedEnd),
            meanOf("bezier_end_mended", draws, mendedEnd),
            meanOf("bezier_end_printed_2", draws, printedEndOfTwo),
            meanOf("bezier_equal_printed", draws,
                   [&](std::int64_t i) { return printedCurve(ones, uniform(seed, timeStream, i)); }),
            meanOf("bezier_equal_mended", draws,
                   [&](std::int64_t i) { return mendedCurve(ones, uniform(seed, timeStream, i)); }),
            meanOf("acceleration_2kg_printed", draws, [](std::int64_t) { return printedAcceleration(2, 1); }),
            meanOf("acceleration_2kg_mended", draws, [](std::int64_t) { return mendedAcceleration(2, 1); }),
            meanOf("momentum_2kg_printed", draws, momentum(2, printedAcceleration)),
            meanOf("momentum_2kg_mended", draws, momentum(2, mendedAcceleration)),
            meanOf("momentum_1kg_printed", draws, momentum(1, printedAcceleration))};
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures what two formulae do that the thesis prints wrongly: weights of Bézier curves, a = m·ΣF.";
    info.source = "Thesis";
    info.run = [](ExperimentContext& context) { return measureFormulae(context.seed(), 10'000); };
    return info;
}

}  // namespace dustbench::particles::formulae
