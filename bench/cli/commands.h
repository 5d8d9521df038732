// The subcommands, each in its own source file, and the exit codes of all.
#pragma once

#include <string>
#include <vector>

#include "bench/cli/arguments.h"
#include "bench/run/run_messages.h"

namespace dustbench::cli {

enum ExitCode {
    exitOk = 0,
    exitRunFailed = 1,
    exitAborted = 2,
    exitBadInput = 3,
    exitInternal = 4,
    exitRegression = 5,
    exitNothingFits = 5,  ///< like a regression, a requested limit is not met
    exitNotComparable = 6,
};

/// What the exception being handled means.
[[nodiscard]] run::RunError errorOfException();
[[nodiscard]] ExitCode exitCodeOf(run::RunError::Kind kind);

[[nodiscard]] Command listCommand();
[[nodiscard]] Command envCommand();
[[nodiscard]] Command runCommand();
[[nodiscard]] Command exportCommand();
[[nodiscard]] Command suiteCommand();
[[nodiscard]] Command mergeCommand();
[[nodiscard]] Command reproduceCommand();
[[nodiscard]] Command reportCommand();
[[nodiscard]] Command recommendCommand();
[[nodiscard]] Command diffCommand();
[[nodiscard]] Command compareCommand();
[[nodiscard]] Command viewCommand();
[[nodiscard]] Command newMethodCommand();
[[nodiscard]] Command bundleCommand();
[[nodiscard]] Command verifyCommand();
[[nodiscard]] Command selfcheckCommand();
[[nodiscard]] Command measureMachineCommand();
/// `completion SHELL` and `manual`, which describe all `commands` and themselves. Add them last.
[[nodiscard]] std::vector<Command> manualCommands(const std::vector<Command>& commands, const CommonOptions& common);
/// The tools that method folders provide, such as `shape`.
[[nodiscard]] std::vector<Command> toolCommands();

/// Runs one measurement in its own process: `measure-run SPEC FOLDER -- the user's command`. Internal.
inline constexpr const char* measureRunName = "measure-run";
[[nodiscard]] int measureRunCommand(const std::vector<std::string>& argv);
/// Starts a run to estimate its duration: `forecast-run SPEC FOLDER --`. Internal.
inline constexpr const char* forecastRunName = "forecast-run";
[[nodiscard]] int forecastRunCommand(const std::vector<std::string>& argv);

}  // namespace dustbench::cli
