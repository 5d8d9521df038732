// Formats a console table: aligned columns, numbers to the right.
#pragma once

#include <string>
#include <vector>

namespace dustbench::cli {

/// The first row is the header. A column is right-aligned if all cells below the header look like numbers or are empty.
[[nodiscard]] std::string textTable(std::vector<std::vector<std::string>> rows);

/// `digits` after the point; empty for NaN.
[[nodiscard]] std::string fixed(double value, int digits);

}  // namespace dustbench::cli
