// Determines how deeply a TOML text nests before it is parsed, because the parser and its result recurse.
#pragma once

#include <cstddef>
#include <string_view>

namespace dustbench::files {

/// The line on which tables, arrays and dotted keys first nest more than `levels` deep; 0 if there is none. For text
/// that is not valid TOML, the result is undefined.
[[nodiscard]] std::size_t tooDeepLine(std::string_view text, int levels);

}  // namespace dustbench::files
