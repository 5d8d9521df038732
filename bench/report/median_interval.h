// The median of a few repetitions, with a confidence interval.
//
// Each value is below the true median with probability 1/2, whatever the distribution. So the median is between the
// order statistics x(j) and x(n+1−j) with probability 1 − 2·Σ_{i<j} C(n, i)/2ⁿ. The maximum j that reaches 95 % is
// used. For fewer than 6 values even the whole range has less; it is returned with its probability. Threads: pure.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace dustbench::report {

struct MedianInterval {
    double median = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
    std::size_t values = 0;
    double probability = 0;  ///< that the interval contains the true median; 0 for one value
};

/// NaN if there are no values.
[[nodiscard]] MedianInterval medianInterval(std::vector<double> values);

}  // namespace dustbench::report
