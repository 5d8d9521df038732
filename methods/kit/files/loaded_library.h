// Finds files next to the library or the program that contains the kit: programs, and libraries that are loaded on
// first use because linking them would slow down every start.
#pragma once

#include <filesystem>
#include <string>

namespace dustbench::files {

/// The path of the file `name` in that folder. The file need not exist.
[[nodiscard]] std::filesystem::path inKitFolder(const std::string& name);

/// The address of `function` in `lib<name>.so` next to the kit. The library is never unloaded. `what` names the
/// purpose in messages: `pictures`. Throws std::runtime_error if either is missing.
[[nodiscard]] DUSTBENCH_API void* functionOf(const std::string& name, const std::string& function,
                                             const std::string& what);

}  // namespace dustbench::files
