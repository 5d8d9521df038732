// Findings from repeated measurements: a mean, a median or an exponent, each with its 95 % interval.
//
// Threads: pure. Source: Student1908.
#pragma once

#include <string>
#include <vector>

#include "methods/contract/experiment.h"

namespace dustbench::findings {

/// The mean of two or more values, with Student's interval.
[[nodiscard]] DUSTBENCH_API Finding meanOf(std::string quantity, const std::vector<double>& values);

/// The median of one or more values, with its interval by order statistics, for any distribution. Below nine values:
/// minimum and maximum.
[[nodiscard]] DUSTBENCH_API Finding medianOf(std::string quantity, std::vector<double> values);

/// b of y = a·xᵇ by least squares on the logarithms of three or more points, with Student's interval.
[[nodiscard]] DUSTBENCH_API Finding exponentOf(std::string quantity, const std::vector<double>& x,
                                               const std::vector<double>& y);

}  // namespace dustbench::findings
