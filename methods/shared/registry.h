// Every method of this build. CMake generates the list from the folders of methods/.
#pragma once

#include <string_view>
#include <vector>

#include "methods/shared/method.h"

namespace dustbench {

/// Sorted by id.
[[nodiscard]] const std::vector<MethodInfo>& methods();

/// Throws InputError with the nearest name.
[[nodiscard]] const MethodInfo& findMethod(std::string_view id);

}  // namespace dustbench
