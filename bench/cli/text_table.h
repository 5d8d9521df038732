// A table for people: columns lined up, numbers to the right.
#pragma once

#include <string>
#include <vector>

namespace dustbench::cli {

/// The first row is the header. A column whose cells below the header all look like numbers (or are empty) is set
/// right.
[[nodiscard]] std::string textTable(const std::vector<std::vector<std::string>>& rows);

/// `digits` after the point; empty for NaN.
[[nodiscard]] std::string fixed(double value, int digits);

}  // namespace dustbench::cli
