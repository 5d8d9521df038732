#include "methods/kit/particles/opacity_curve.h"

namespace dustbench::particles {
namespace {

constexpr double maximumOpacity = 0.999;

void linearOpacity(std::size_t count, const float* __restrict share, float* __restrict opacity, float start,
                   float end) {
    const float change = end - start;
    for (std::size_t i = 0; i < count; ++i) opacity[i] = start + change * share[i];
}

void bezierOpacity(std::size_t count, const float* __restrict share, float* __restrict opacity,
                   const maths::CubicPolynomial<float> curve) {
    // Rounding may make a curve that ends at 0 slightly negative.
    for (std::size_t i = 0; i < count; ++i) {
        const float value = curve(share[i]);
        opacity[i] = value > 0.0f ? value : 0.0f;
    }
}

void limitOpacity(std::size_t count, float* __restrict opacity, float maximum) {
    for (std::size_t i = 0; i < count; ++i) opacity[i] = opacity[i] < maximum ? opacity[i] : maximum;
}

float valueOf(const ParameterValues& values, const char* name) {
    return static_cast<float>(values.real(name));
}

}  // namespace

void OpacityCurve::declare(ParameterSet& set) {
    set.choice("opacity_curve", Form::linear, forms,
               "opacity over life: linear from start to end, or a cubic curve with two values in between")
        .real("opacity_start", 0.25, 0, maximumOpacity, "", "peak opacity at birth")
        .real("opacity_early", 0.17, 0, maximumOpacity, "", "second control value of the curve")
        .real("opacity_late", 0.08, 0, maximumOpacity, "", "third control value of the curve")
        .real("opacity_end", 0, 0, maximumOpacity, "", "peak opacity at death");
}

OpacityCurve::OpacityCurve(const ParameterValues& values, maths::SamplingMode mode)
    : form_(values.choice("opacity_curve", forms)),
      printed_(mode == maths::SamplingMode::paper),
      start_(valueOf(values, "opacity_start")),
      end_(valueOf(values, "opacity_end")) {
    const float early = valueOf(values, "opacity_early"), late = valueOf(values, "opacity_late");
    curve_ = printed_ ? maths::printedBezierPolynomial(start_, early, late, end_)
                      : maths::bezierPolynomial(start_, early, late, end_);
}

void OpacityCurve::write(const float* share, float* opacity, std::size_t count) const {
    if (form_ == Form::linear)
        linearOpacity(count, share, opacity, start_, end_);
    else
        bezierOpacity(count, share, opacity, curve_);
    if (printed_) limitOpacity(count, opacity, static_cast<float>(maximumOpacity));
}

}  // namespace dustbench::particles
