// Text of files and file names, made harmless for a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dustbench::files {

/// Bytes of a message: what a reader takes in, and what a log can keep.
inline constexpr std::size_t maximumMessageBytes = 950;

/// One line: line ends and tabs become blanks; other control characters, marks that turn the direction of writing, and
/// what is not UTF-8 become `\xNN`. Ends with ` […]` if it would be longer than `maximumBytes`.
[[nodiscard]] DUSTBENCH_API std::string printable(std::string_view text,
                                                  std::size_t maximumBytes = maximumMessageBytes);

/// Whether all of it is UTF-8, as what is written to JSON must be.
[[nodiscard]] DUSTBENCH_API bool isUtf8(std::string_view text);

/// `array 'material'`, one line whatever the name is; at most 60 bytes of it.
[[nodiscard]] DUSTBENCH_API std::string namedPart(std::string_view kind, std::string_view name);

}  // namespace dustbench::files
