// The parameter `mode` of parts whose formula in the thesis has an error.
#pragma once

#include "methods/contract/choices.h"
#include "methods/kit/maths/sampling.h"

namespace dustbench::particles {

inline constexpr Choices<maths::SamplingMode> samplingModes{{"paper", maths::SamplingMode::paper},
                                                            {"fixed", maths::SamplingMode::fixed}};

}  // namespace dustbench::particles
