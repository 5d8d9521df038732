// Builds a suite that compares several methods side by side in one world.
#pragma once

#include <string>
#include <vector>

#include "bench/suite/suite.h"

namespace dustbench::suite {

/// Each method is `METHOD` or `METHOD:name=value,name=value`, with parameters of that method. `given` contains further
/// parameters, of the world or of methods; each method gets those that it has. Every method gets metrics and is
/// compared with the first one. `base` specifies the rest. Throws InputError.
[[nodiscard]] Suite sideBySideSuite(const std::vector<std::string>& variants, const results::ParameterTexts& given,
                                    const results::RunSpec& base, int repetitions);

}  // namespace dustbench::suite
