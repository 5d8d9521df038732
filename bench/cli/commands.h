// The subcommands, one source file each.
#pragma once

#include <string>
#include <vector>

#include "bench/cli/arguments.h"

namespace dustbench::cli {

[[nodiscard]] Command listCommand();
[[nodiscard]] Command envCommand();
[[nodiscard]] Command runCommand();
[[nodiscard]] Command exportCommand();
[[nodiscard]] Command suiteCommand();
[[nodiscard]] Command mergeCommand();
[[nodiscard]] Command reproduceCommand();
[[nodiscard]] Command reportCommand();
[[nodiscard]] Command diffCommand();
[[nodiscard]] Command compareCommand();

/// What a run's own process does: `measure-run SPEC FOLDER -- the user's command`. Not for people.
inline constexpr const char* childCommandName = "measure-run";
[[nodiscard]] int measureRunCommand(const std::vector<std::string>& argv);

}  // namespace dustbench::cli
