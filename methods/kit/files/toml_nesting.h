// How deeply a TOML text nests, found before the text is parsed: the parser recurses, and so does what it returns.
#pragma once

#include <cstddef>
#include <string_view>

namespace dustbench::files {

/// The line on which tables, arrays and dotted keys first nest more than `levels` deep; 0: nowhere. Text that is not
/// valid TOML gives any answer.
[[nodiscard]] std::size_t tooDeepLine(std::string_view text, int levels);

}  // namespace dustbench::files
