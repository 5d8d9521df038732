// Quotes words for a POSIX shell, and splits a command line into words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dustbench::results {

/// The text as one word, quoted if necessary.
[[nodiscard]] std::string shellQuoted(const std::string& text);

/// The words of a line. Quotes and backslashes have their meaning in a shell; a backslash before a line break continues
/// the line. Variables and other expansions are not expanded. Throws InputError for a quote that is not closed.
[[nodiscard]] std::vector<std::string> shellWords(std::string_view line);

}  // namespace dustbench::results
