// The command's exit codes.
#pragma once

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

}  // namespace dustbench::cli
