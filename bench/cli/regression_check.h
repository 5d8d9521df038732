// Implements `dustbench compare DIR_A DIR_B`, the comparison of two results folders.
#pragma once

#include <optional>
#include <string>

namespace dustbench::cli {

struct RegressionOptions {
    std::string a, b;
    std::string columns;  ///< separated by commas; empty: frame_ms_median
    std::string out;      ///< empty: no comparison.csv
    std::optional<double> failPercent;
    bool acrossMachines = false;
    std::string markdown;  ///< file; empty: none
};

/// Returns the exit code. Throws InputError.
[[nodiscard]] int checkRegression(const RegressionOptions& options);

}  // namespace dustbench::cli
