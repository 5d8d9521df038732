// A speed drawn at birth: average + R·variation with R in [−1, 1). Negative speeds go backwards.
//
// Units: m/s. Threads: pure. Source: Thesis, 4.3.1.
#pragma once

#include "methods/contract/parameters.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::particles {

class RandomSpeed {
 public:
    static void declare(ParameterSet& set) {
        set.real("speed", 2, -1000, 1000, "m/s", "mean speed")
            .real("variation", 0, 0, 1000, "m/s", "maximum deviation from the mean");
    }
    explicit RandomSpeed(const ParameterValues& values)
        : average_(static_cast<float>(values.real("speed"))),
          variation_(static_cast<float>(values.real("variation"))) {}

    /// `u`: uniform in [0, 1).
    [[nodiscard]] float operator()(float u) const { return average_ + maths::centred(u) * variation_; }

 private:
    float average_, variation_;
};

}  // namespace dustbench::particles
