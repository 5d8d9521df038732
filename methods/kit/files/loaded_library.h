// What stands beside the library or the program that holds the kit: libraries that are loaded on first use, because
// linking them would slow down every start, and programs of the kit.
#pragma once

#include <filesystem>
#include <string>

namespace dustbench::files {

/// The file `name` there, which need not exist.
[[nodiscard]] std::filesystem::path besideKit(const std::string& name);

/// The address of `function` in `lib<name>.so` beside the kit. The library is never unloaded. `what` is for
/// messages: `pictures`. Throws std::runtime_error if either is missing.
[[nodiscard]] void* functionOf(const std::string& name, const std::string& function, const std::string& what);

}  // namespace dustbench::files
