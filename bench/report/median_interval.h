// The median of a few repetitions and how far it is known.
//
// Each value lies below the true median with probability 1/2, whatever the distribution, so between the order
// statistics x(j) and x(n+1−j) it lies with probability 1 − 2·Σ_{i<j} C(n, i)/2ⁿ. The maximum j that has 95 % is
// taken; below 6 values even the whole range has less, and is given all the same, with its probability. Threads: pure.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace dustbench::bench {

struct MedianInterval {
    double median = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
    std::size_t values = 0;
    double probability = 0;  ///< that the true median lies in it; 0 for one value
};

/// NaN for no values.
[[nodiscard]] MedianInterval medianInterval(std::vector<double> values);

}  // namespace dustbench::bench
