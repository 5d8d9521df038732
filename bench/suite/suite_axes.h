// What varies between the configurations (cells) of a suite: the world, which all methods share, and method settings.
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

/// Those of scene, drive, size and the world's parameters that vary between configurations.
[[nodiscard]] std::vector<Axis> worldAxes(std::span<const PlannedRun* const> cells);

/// Method parameters that vary between configurations of one method. Parameters that only differ between methods are
/// part of the suite's setup.
[[nodiscard]] std::vector<Axis> methodAxes(std::span<const PlannedRun* const> cells);

/// `particles=500 speed=20`; empty values are omitted.
[[nodiscard]] std::string labelOf(const std::vector<Axis>& axes, const RunSpec& spec);

/// Scene, drive, size, seed and the world's parameters: equal for runs in the same world.
[[nodiscard]] std::string worldKey(const RunSpec& spec);

[[nodiscard]] bool isOfTheWorld(std::string_view parameter);

[[nodiscard]] std::vector<const PlannedRun*> cellsOf(const Suite& suite);

}  // namespace dustbench::bench
