// The facts that the methods of this build declare (methods/contract/facts.h); each is a column of summary.csv.
#pragma once

#include <string>
#include <vector>

#include "methods/contract/facts.h"

namespace dustbench::bench {

struct MethodFact {
    FactInfo info;
    std::vector<std::string> methods;  ///< the methods that declare it, sorted
};

/// Sorted by name. Throws std::logic_error if two methods declare the same name with different meanings.
[[nodiscard]] const std::vector<MethodFact>& methodFacts();

}  // namespace dustbench::bench
