// Libraries beside the program that are loaded on first use, because linking them would slow down every start.
#pragma once

#include <string>

namespace dustbench::files {

/// The address of `function` in `lib<name>.so` beside the program. The library is never unloaded. `what` is for
/// messages: `pictures`. Throws std::runtime_error if either is missing.
[[nodiscard]] void* functionOf(const std::string& name, const std::string& function, const std::string& what);

}  // namespace dustbench::files
