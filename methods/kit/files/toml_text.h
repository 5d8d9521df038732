// Writes TOML values.
#pragma once

#include <string>
#include <string_view>

namespace dustbench::files {

/// The text as a TOML basic string, quoted and escaped.
[[nodiscard]] DUSTBENCH_API std::string tomlText(std::string_view text);

}  // namespace dustbench::files
