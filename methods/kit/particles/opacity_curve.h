// Opacity α by age, shared by all colour parts. At most 0.999, so that τ is finite.
//
// Source: Thesis, 4.4.2 and 4.4.3 (the fourth component of a colour).
#pragma once

#include <cstddef>

#include "methods/contract/parameters.h"
#include "methods/kit/maths/bezier.h"
#include "methods/kit/maths/sampling.h"

namespace dustbench::particles {

class OpacityCurve {
 public:
    static void declare(ParameterSet& set);
    /// `mode` paper: the cubic curve with the printed weights (maths/bezier.h), limited to 0.999.
    explicit OpacityCurve(const ParameterValues& values, maths::SamplingMode mode = maths::SamplingMode::fixed);

    void write(const float* share, float* opacity, std::size_t count) const;

 private:
    enum class Form { linear, bezier };
    static constexpr Choices<Form> forms{{"linear", Form::linear}, {"bezier", Form::bezier}};

    Form form_;
    bool printed_;
    float start_, end_;
    maths::CubicPolynomial<float> curve_;
};

}  // namespace dustbench::particles
