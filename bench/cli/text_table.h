// Formats a console table with aligned columns.
#pragma once

#include <string>
#include <vector>

namespace dustbench::cli {

/// The first row is the header. A column is right-aligned if all cells below the header look like numbers or are empty.
[[nodiscard]] std::string textTable(std::vector<std::vector<std::string>> rows);

/// `digits` after the decimal point; empty if not finite.
[[nodiscard]] std::string fixed(double value, int digits);

}  // namespace dustbench::cli
