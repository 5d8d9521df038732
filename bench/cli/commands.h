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

/// What a run's own process does: `measure-run SPEC FOLDER -- the user's command`. Internal.
inline constexpr const char* measureRunName = "measure-run";
[[nodiscard]] int measureRunCommand(const std::vector<std::string>& argv);
/// The same for a run that is only begun, to estimate its duration: `forecast-run SPEC FOLDER --`.
inline constexpr const char* forecastRunName = "forecast-run";
[[nodiscard]] int forecastRunCommand(const std::vector<std::string>& argv);

}  // namespace dustbench::cli
