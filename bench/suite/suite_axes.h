// What differs between the cells of a suite: the world that all methods are shown, and the settings of each method.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/suite/suite.h"

namespace dustbench::bench {

struct Axis {
    std::string name;
    std::function<std::string(const RunSpec&)> of;
};

/// Scene, drive, size and the world's parameters, as far as they are not the same in all cells.
[[nodiscard]] std::vector<Axis> worldAxes(std::span<const PlannedRun* const> cells);

/// Parameters of their methods that take several values among the cells of one method. What merely differs from method
/// to method is how the suite sets them up.
[[nodiscard]] std::vector<Axis> methodAxes(std::span<const PlannedRun* const> cells);

/// `particles=500 speed=20`; values that are empty are left out.
[[nodiscard]] std::string labelOf(const std::vector<Axis>& axes, const RunSpec& spec);

[[nodiscard]] bool isOfTheWorld(std::string_view parameter);

[[nodiscard]] std::vector<const PlannedRun*> cellsOf(const Suite& suite);

}  // namespace dustbench::bench
