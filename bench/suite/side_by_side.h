// Several methods side by side in one world, as a suite of its own.
#pragma once

#include <string>
#include <vector>

#include "bench/suite/suite.h"

namespace dustbench::bench {

/// `METHOD` or `METHOD:name=value,name=value`: parameters of that method's own. `given` holds further ones, of the
/// world or of methods; those of methods go to each that has them. Every method is judged and compared with the first.
/// `base` says all else of the runs. Throws InputError.
[[nodiscard]] Suite sideBySideSuite(const std::vector<std::string>& variants, const ParameterTexts& given,
                                    const RunSpec& base, int repetitions);

}  // namespace dustbench::bench
