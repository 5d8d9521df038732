// How long a list of runs will still take, from those that have ended.
//
// Units: seconds.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "bench/suite/suite.h"

namespace dustbench::bench {

class RemainingTime {
 public:
    /// The runs still to do, in order.
    explicit RemainingTime(const std::vector<const PlannedRun*>& toDo);

    /// The next of them took so long.
    void ended(double seconds);
    /// Of all that is left: a run counts as long as the other repetitions of its cell did, the first of a cell as long
    /// as all others on average. Negative while nothing is known.
    [[nodiscard]] double seconds() const;

 private:
    struct Ended {
        double sum = 0;
        std::size_t count = 0;
        [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
    };
    std::vector<std::string> cells_;  ///< of each run: what its repetitions have in common
    std::size_t next_ = 0;
    std::map<std::string, Ended> byCell_;
    Ended all_;
};

}  // namespace dustbench::bench
