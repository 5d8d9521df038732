// Builds a suite that compares several methods side by side in one world.
#pragma once

#include <string>
#include <vector>

#include "bench/suite/suite.h"

namespace dustbench::bench {

/// `METHOD` or `METHOD:name=value,name=value` with parameters of that method. `given` holds further parameters, of the
/// world or of methods; those of methods are given to each method that has them. Every method is judged and compared
/// with the first. `base` specifies the rest. Throws InputError.
[[nodiscard]] Suite sideBySideSuite(const std::vector<std::string>& variants, const ParameterTexts& given,
                                    const RunSpec& base, int repetitions);

}  // namespace dustbench::bench
