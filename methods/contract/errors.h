// Errors that a method throws: what a person can mend (wrong names, values, files, machines: one line, exit code 3),
// and a simulation that breaks down (the run fails, exit code 1).
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace dustbench {

/// Bad input or an unusable machine. The message is one line: what it concerns, what was got, what is allowed.
class DUSTBENCH_API InputError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
    InputError(const InputError&) = default;
    InputError& operator=(const InputError&) = default;
    ~InputError() override;
};

/// A simulation that broke down in the middle of a run, through no fault of the program: its state cannot be gone on
/// from (a number that is none, for example). The message is one line and says where. The run fails (exit code 1).
class DUSTBENCH_API SimulationError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
    SimulationError(const SimulationError&) = default;
    SimulationError& operator=(const SimulationError&) = default;
    ~SimulationError() override;
};

/// `unknown method 'bilboard' (did you mean 'billboard'?); known: billboard, octree_search`
/// The suggestion is left out where nothing is near.
[[nodiscard]] DUSTBENCH_API InputError unknownName(std::string_view kind, std::string_view got,
                                                   std::span<const std::string> known);

/// The known name nearest by edit distance, or empty where all differ by more than a third of their letters.
[[nodiscard]] std::string nearestName(std::string_view got, std::span<const std::string> known);

}  // namespace dustbench
