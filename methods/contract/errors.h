// Errors that a method throws: user-correctable errors (wrong names, values, files or machines: one line, exit code 3)
// and simulations that break down (the run fails, exit code 1).
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace dustbench {

/// Bad input or an unusable machine. The message is one line: the subject, the value received, the values allowed.
class DUSTBENCH_API InputError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
    InputError(const InputError&) = default;
    InputError& operator=(const InputError&) = default;
    ~InputError() override;
};

/// A simulation that breaks down during a run through no fault of the program: its state is unusable (NaN, for
/// example). The message is one line and says where. The run fails (exit code 1).
class DUSTBENCH_API SimulationError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
    SimulationError(const SimulationError&) = default;
    SimulationError& operator=(const SimulationError&) = default;
    ~SimulationError() override;
};

/// `unknown method 'bilboard' (did you mean 'billboard'?); known: billboard, octree_search`
/// Omits the suggestion if no known name is close.
[[nodiscard]] DUSTBENCH_API InputError unknownName(std::string_view kind, std::string_view got,
                                                   std::span<const std::string> known);

/// The known name nearest to `got` by edit distance; empty if all differ by more than a third of the letters of `got`.
[[nodiscard]] std::string nearestName(std::string_view got, std::span<const std::string> known);

}  // namespace dustbench
