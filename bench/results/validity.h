// Whether a run showed what was asked of it. A run that did not says why, and no claim uses it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/results/run_record.h"
#include "methods/contract/method.h"

namespace dustbench::bench {

/// The shared dust, as it was asked for and as it was.
struct DustCount {
    std::int64_t asked = 0;     ///< by `particles=N`; 0: no number
    double medianOfFrames = 0;  ///< particles alive
    bool isShown = true;        ///< false for the null method and for methods with a simulation of their own
};

/// Lifetimes are random, so the particles alive scatter around the number asked for, by √N at most. This many times
/// that is no chance: 6 in 10 million.
inline constexpr double countDeviations = 5;

/// A short reason for each declared fact outside of its valid range, and for a number of particles that misses the one
/// asked for. Empty for a valid run.
[[nodiscard]] std::vector<std::string> whyInvalid(const MethodInfo& method, const Columns& facts,
                                                  const DustCount& dust);

}  // namespace dustbench::bench
