// The facts that the methods of this build declare (methods/contract/facts.h), each a column of summary.csv, and
// whether those of a run are what its specification asked for. Claims do not use runs that are not valid.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/results/run_record.h"
#include "methods/contract/facts.h"
#include "methods/contract/method.h"

namespace dustbench::results {

struct MethodFact {
    FactInfo info;
    std::vector<std::string> methods;  ///< the methods that declare it, sorted
};

/// Sorted by name. Throws std::logic_error if two methods declare the same name with different meanings.
[[nodiscard]] const std::vector<MethodFact>& methodFacts();

/// The shared dust: requested and actual numbers of particles.
struct DustCount {
    std::int64_t asked = 0;     ///< by `particles=N`; 0: not specified
    double medianOfFrames = 0;  ///< particles alive
    bool isShown = true;        ///< false for the null method and methods with their own simulation
};

/// Lifetimes are random, so the number of living particles scatters around the requested number by at most √N. A
/// deviation of this many times √N has a probability of 6 in 10 million.
inline constexpr double countDeviations = 5;

/// A short reason for each declared fact outside its valid range, and for a number of particles that differs from the
/// requested one. Empty for a valid run.
[[nodiscard]] std::vector<std::string> whyInvalid(const MethodInfo& method, const Columns& facts,
                                                  const DustCount& dust);

}  // namespace dustbench::results
