// A simulation that broke down in the middle of a run, through no fault of the program: the run fails.
#pragma once

#include <stdexcept>

namespace dustbench {

/// The state cannot be gone on from, a number that is none for example. The message is one line and says where. The
/// command prints it and ends with exit code 1, as for every run that fails.
class SimulationError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

}  // namespace dustbench
