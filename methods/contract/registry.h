// All methods, experiments and tools of this build. CMake generates the lists from the folders of methods/.
#pragma once

#include <string_view>
#include <vector>

#include "methods/contract/experiment.h"
#include "methods/contract/method.h"

namespace dustbench {

/// Sorted by id.
[[nodiscard]] const std::vector<MethodInfo>& methods();

/// Throws InputError with the nearest name.
[[nodiscard]] const MethodInfo& findMethod(std::string_view id);

/// Sorted by id.
[[nodiscard]] const std::vector<ExperimentInfo>& experiments();

/// Throws InputError with the nearest name.
[[nodiscard]] const ExperimentInfo& findExperiment(std::string_view id);

/// Sorted by id.
[[nodiscard]] const std::vector<ToolInfo>& tools();

}  // namespace dustbench
