// A budget for a method: the time that it may add to a frame.
//
// Units: ms.
#pragma once

#include <string>

namespace dustbench::bench {

struct Budget {
    double ms = 0;
    std::string asked;  ///< as given: `4ms`, `60fps`
};

/// Reads `4ms`, `0.25 ms`, or a frame rate: `60fps` is 1000/60 ms for the method. Throws InputError that begins with
/// `what`.
[[nodiscard]] Budget parseBudget(const std::string& what, const std::string& text);

}  // namespace dustbench::bench
