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

/// Adds a method from outside, whose `id` and `library` are set. References into methods() become invalid. Throws
/// InputError if the id is taken.
void addMethod(MethodInfo info);
/// A method of this id is outside, and cannot be taken: for the message of findMethod.
void noteRefusedMethod(const std::string& id, const std::string& library, const std::string& why);

/// A method's library is noted as an input of the run. Throws InputError with the nearest name.
[[nodiscard]] const MethodInfo& findMethod(std::string_view id);

/// Sorted by id.
[[nodiscard]] const std::vector<ExperimentInfo>& experiments();

/// Throws InputError with the nearest name.
[[nodiscard]] const ExperimentInfo& findExperiment(std::string_view id);

/// Sorted by id.
[[nodiscard]] const std::vector<ToolInfo>& tools();

}  // namespace dustbench
