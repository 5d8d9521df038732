// Makes text from files and file names safe to print on a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dustbench::files {

/// Maximum bytes of a message, short enough to read and to log.
inline constexpr std::size_t maximumMessageBytes = 950;

/// One line: line ends and tabs become blanks. Other control characters, bidirectional marks and bytes that are not
/// UTF-8 become `\xNN`. Ends with ` […]` if it would be longer than `maximumBytes`.
[[nodiscard]] DUSTBENCH_API std::string printable(std::string_view text,
                                                  std::size_t maximumBytes = maximumMessageBytes);

/// True if the whole text is UTF-8, which JSON requires.
[[nodiscard]] DUSTBENCH_API bool isUtf8(std::string_view text);

/// `array 'material'`, always one line, with at most 60 bytes of the name.
[[nodiscard]] DUSTBENCH_API std::string namedPart(std::string_view kind, std::string_view name);

}  // namespace dustbench::files
