// All methods, experiments and tools of this build. CMake generates the lists from the folders of methods/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/experiment.h"
#include "methods/contract/method.h"

namespace dustbench {

/// Sorted by id.
[[nodiscard]] const std::vector<MethodInfo>& methods();

/// Adds a method from a library, with `id` and `library` set. References into methods() become invalid. Throws
/// InputError if the id is taken.
void addMethod(MethodInfo info);
/// Records that the library of this method was not loaded, for the message of findMethod.
void noteRefusedMethod(const std::string& id, const std::string& library, const std::string& why);

/// Notes the method's library as an input of the run. Throws InputError, which suggests the nearest name.
[[nodiscard]] const MethodInfo& findMethod(std::string_view id);

/// Sorted by id.
[[nodiscard]] const std::vector<ExperimentInfo>& experiments();

/// Throws InputError, which suggests the nearest name.
[[nodiscard]] const ExperimentInfo& findExperiment(std::string_view id);

/// Sorted by id.
[[nodiscard]] const std::vector<ToolInfo>& tools();

}  // namespace dustbench
